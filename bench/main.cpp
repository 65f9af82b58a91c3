// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <map>

#include <tetralight/bench/harness.h>
#ifdef TETRALIGHT_HAS_SERVER
#include <tetralight/bench/server.h>
#endif

int main(int argc, char** argv) {
    using namespace tetralight::bench;
    const std::map<std::string, void (*)(const Options&)> benches{
        {"bake", bench_bake},
        {"engines", bench_engines},
        {"farm", bench_farm},
        {"query", bench_query},
        {"reflection", bench_reflection},
        {"relight", bench_relight},
        {"grid", bench_grid},
        {"leaks", bench_leaks},
        {"lightmap", bench_lightmap},
        {"lppv", bench_lppv},
        {"runtime", bench_runtime},
        {"scene", bench_scene},
#ifdef TETRALIGHT_HAS_SERVER
        {"server", bench_server},
#endif
        {"tetrahedralize", bench_tetrahedralize},
        {"verify", bench_verify},
        {"world", bench_world}};

    CLI::App app("Runs benchmarks and prints one JSON object a figure.", "tetralight_bench");
    Options options;
    std::vector<std::string> names;
    app.add_option("NAME", names, "Benchmarks to run (default: all)")
        ->check(CLI::IsMember(benches));
    app.add_option("--scene", options.scene, "glTF scene for the benchmarks that can use one");
    app.add_option("--repetitions", options.repetitions, "Runs of each contestant")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_flag("--quick", options.is_quick, "Skip the benchmarks that take minutes");
    app.add_option("--convergence", options.convergence,
                   "`bake` writes a CSV file of errors over rays instead of its figures");
    app.add_option(
        "--only", options.only,
        "The scene that `bake`, `farm`, `grid`, `relight` or `verify` runs alone. bake: "
        "courtyard, scene, rooms, rooms_sky, emitters or white_room. grid: courtyard, house, "
        "rooms, interior or scene. relight: courtyard, scene or emitters. farm: courtyard, scene, "
        " rooms, emitters or collect. verify: courtyard, scene, emitters or white_room");
    app.add_option("--figure", options.figure,
                   "The figures that `bake` measures alone: time, rays, noise, layers, bounces, "
                   "dering or threads; and `lightmap`: directional, shadowmask or layers")
        ->check(CLI::IsMember({"time", "rays", "noise", "layers", "bounces", "dering", "threads",
                               "directional", "shadowmask"}));
    app.add_option("--pmrem", options.pmrem,
                   "Folder into which `reflection` writes cubes for the comparison with three.js, "
                   "instead of its figures")
        ->check(CLI::ExistingDirectory);
    CLI11_PARSE(app, argc, argv);
    for (const auto& [name, bench] : benches) {
        if (names.empty() || std::ranges::find(names, name) != names.end()) bench(options);
    }
    return 0;
}
