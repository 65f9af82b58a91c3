// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv.h>

#include <filesystem>
#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/base/box.h>
#include <tetralight/base/stopwatch.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/lppv_grid_options.h>
#include <tetralight/cli/lppv_warnings.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/lppv/sparse_lppv.h>
#include <tetralight/pipeline/lppv_coverage.h>
#include <tetralight/pipeline/lppv_validity.h>
#include <tetralight/pipeline/sparse_blocks.h>
#include <tetralight/pipeline/write_lppv.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#ifdef TETRALIGHT_HAS_OPENVDB
#include <tetralight/lppv/vdb/write_vdb.h>
#endif

namespace tetralight::cli {
namespace {

/// In the order of the choices of `layout`.
enum class Layout : uint8_t { Automatic, Four, Seven };

/// Bytes of what was written; 0 for stdout and devices.
uint64_t file_size(const std::string& path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

Json resolution_json(const glm::uvec3& v) {
    return {v.x, v.y, v.z};
}

Json bounds_json(const glm::dvec3& low, const glm::dvec3& high,
                 const glm::dmat4& world_from_local = glm::dmat4(1.0)) {
    const double* matrix = glm::value_ptr(world_from_local);
    return {{"low", to_json(low)},
            {"high", to_json(high)},
            {"world_from_local", std::vector<double>(matrix, matrix + 16)}};
}

Json coverage_json(const LppvCoverage& coverage, bool has_scene) {
    Json positions = Json::array();
    for (const UncoveredPoint& point : coverage.positions) {
        positions.push_back(to_json(point.position));
    }
    const Coverage& points = coverage.points;
    return {{"points", points.place_count()},
            {"covered", points.count(Cover::Covered)},
            {"outside", points.count(Cover::HullCell)},
            {"unseen", has_scene ? Json(points.count(Cover::Unseen)) : Json(nullptr)},
            {"positions", positions}};
}

/// The box around the active points of a sparse grid; without blocks a point.
Box<glm::ivec3> box_of(const SparseLppv& lppv) {
    if (lppv.blocks.empty()) return {};
    Box<glm::ivec3> blocks{lppv.blocks[0], lppv.blocks[0]};
    for (const glm::ivec3& block : lppv.blocks) blocks = union_of(blocks, block);
    return {blocks.min * kSparseBlockSide, (blocks.max + 1) * kSparseBlockSide - 1};
}

/// What is known of the points of a grid before they have light.
struct Survey {
    /// As `LppvFill::validity`: empty without a scene.
    std::vector<float> validity;
    LppvCoverage coverage;
};

struct LppvCommand {
    std::string volume_path;
    std::string scene_path;
    SceneReading reading;
    std::string output;
    LppvGridOptions grid;
    LppvFill fill;
    LppvFileSettings file;
    bool is_sparse = false;
    double reach = 0.0;
    CommonOptions common;
    const Values* values;

    /// Keeps a reference.
    explicit LppvCommand(const Values& given)
        : volume_path(given.text("volume")),
          scene_path(given.text("scene")),
          reading(scene_reading(given)),
          output(given.text("output")),
          grid(given),
          is_sparse(given.flag("sparse")),
          reach(given.number("reach")),
          common(given),
          values(&given) {
        fill.quality = choice<LppvQuality>(given, "mode");
        fill.receiver.rendering_layers = given.bits("rendering_layers", kAllRenderingLayers);
        fill.receiver.radius = given.number32("radius");
        file.precision = choice<LppvTexelFormat>(given, "precision");
        file.thread_count = common.thread_count;
        file.kind = lppv_file_kind(output == "-" ? "" : output).value_or(LppvFileKind::OpenVdb);
        const auto layout = choice<Layout>(given, "layout");
        const bool is_full = fill.quality == LppvQuality::Full;
        const bool is_seven = layout == Layout::Seven || (layout == Layout::Automatic && is_full);
        file.layout = is_seven ? LppvLayout::SevenSlabs : LppvLayout::FourSlabs;
        check_file();
    }

    /// Throws a `UsageError` if settings do not go with the kind of file.
    void check_file() const {
        const bool is_nano = file.kind == LppvFileKind::NanoVdb;
        if (is_sparse && !is_nano && file.kind != LppvFileKind::OpenVdb) {
            refuse(*values, "sparse", "only .vdb and .nvdb files can be sparse");
        }
        if (is_nano && values->is_given("precision") && file.precision == LppvTexelFormat::Half) {
            refuse(*values, "precision", ".nvdb files have floats");
        }
        if (values->is_given("layout") && !is_texture(file.kind)) {
            refuse(*values, "layout", "only .dds and .ktx2 files have slabs");
        }
    }

    [[nodiscard]] auto threads() const {
        return
            [this](size_t count, auto&& task) { parallel_for(count, common.thread_count, task); };
    }

    Status run() {
        if (auto status = check_output(output, {volume_path, scene_path}); !status) return status;
        const auto probes = open_probe_file(volume_path);
        if (!probes) return probes.error();
        common.warn_if_unlit(volume_path, probes->view());
        Scene scene;
        if (!scene_path.empty()) {
            auto read = read_scene(scene_path, reading);
            if (!read) return read.error();
            common.warn(read->warnings);
            scene = std::move(*read);
        }
        return is_sparse ? run_sparse(scene, probes->view()) : run_dense(scene, probes->view());
    }

    [[nodiscard]] Result<Survey> survey(const Scene& scene, const ProbeVolumeView& volume,
                                        const LppvGrid& points) const {
        if (scene_path.empty()) {
            return Survey{{}, find_lppv_coverage(volume, points, common.thread_count)};
        }
        const auto traced = TraceScene::make_static(scene);
        if (!traced) return traced.error();
        Survey found;
        found.validity = lppv_grid_validity(*traced, points, common.thread_count);
        found.coverage = find_lppv_coverage(
            volume, points, {*traced, found.validity, fill.min_validity}, common.thread_count);
        return found;
    }

    Status run_dense(const Scene& scene, const ProbeVolumeView& volume) {
        const auto points = grid.make_grid(scene, volume);
        if (!points) return points.error().in(scene_path);
        common.warn(grid.warnings(*points));
        const auto found = survey(scene, volume, *points);
        if (!found) return found.error().in(scene_path);
        fill.validity = found->validity;
        const Stopwatch filling;
        const auto lppv = make_lppv(volume, *points, fill, threads());
        if (!lppv) return lppv.error();
        const double fill_seconds = filling.seconds();
        const Stopwatch writing;
        if (auto status = write_lppv(output, *lppv, file); !status) return status;
        common.warn(lppv_warnings(*lppv, file));
        common.warn(coverage_warnings(found->coverage));
        report(*lppv, found->coverage, fill_seconds, writing.seconds());
        return Ok{};
    }

    void report(const Lppv& lppv, const LppvCoverage& coverage, double fill_seconds,
                double write_seconds) const {
        const LppvGrid& points = lppv.grid;
        Json json{{"output", output},
                  {"bounds", bounds_json(points.min, points.max, points.world_from_local)},
                  {"resolution", resolution_json(points.resolution)},
                  {"spacing", to_json(points.spacing())},
                  {"points", points.point_count()},
                  {"replaced", lppv.replaced_count},
                  {"coverage", coverage_json(coverage, !scene_path.empty())},
                  {"bytes", file_size(output)},
                  {"fill_seconds", fill_seconds},
                  {"write_seconds", write_seconds}};
        if (is_texture(file.kind)) {
            json["constants"] = Json::parse(lppv_constants_json(lppv, file.layout));
        }
        const glm::uvec3& size = points.resolution;
        common.report(
            output, json,
            str_cat(output, ": ", size.x, " x ", size.y, " x ", size.z, " points, ",
                    magnitude(static_cast<double>(file_size(output))), "B, filled in ",
                    duration(fill_seconds), ", written in ", duration(write_seconds),
                    lppv.replaced_count == 0 ? ""
                                             : str_cat("; ", counted(lppv.replaced_count, "point"),
                                                       " in geometry took the light beside")));
    }

#ifdef TETRALIGHT_HAS_OPENVDB
    Status run_sparse(const Scene& scene, const ProbeVolumeView& volume) {
        SparseBlocks blocks(1.0 / grid.settings.density);
        const double near = reach > 0.0 ? reach : blocks.spacing();
        auto status = add_blocks_near_probes(volume, near, blocks);
        if (status) status = add_blocks_near_surfaces(scene, near, blocks);
        if (!status) {
            refuse_because(*values, reach > 0.0 ? "reach" : "density", status.error());
        }
        const Stopwatch filling;
        const SparseLppv lppv = make_sparse_lppv(volume, blocks, threads(), fill.receiver);
        const double fill_seconds = filling.seconds();
        const Stopwatch writing;
        const auto precision =
            file.precision == LppvTexelFormat::Half ? VdbPrecision::Half : VdbPrecision::Float;
        status = file.kind == LppvFileKind::NanoVdb
                     ? write_nvdb(output, lppv, common.thread_count)
                     : write_vdb(output, lppv, precision, common.thread_count);
        if (!status) return status;
        common.warn(half_warnings(largest_coefficient(lppv.irradiance), file));
        const Box<glm::ivec3> box = box_of(lppv);
        common.report(
            output,
            {{"output", output},
             {"bounds",
              bounds_json(lppv.spacing * glm::dvec3(box.min), lppv.spacing * glm::dvec3(box.max))},
             {"resolution", resolution_json(glm::uvec3(box.max - box.min + 1))},
             {"spacing", lppv.spacing},
             {"blocks", lppv.blocks.size()},
             {"points", lppv.irradiance.size()},
             {"bytes", file_size(output)},
             {"fill_seconds", fill_seconds},
             {"write_seconds", writing.seconds()}},
            str_cat(output, ": ", counted(lppv.blocks.size(), "block"), " of 512 points, ",
                    magnitude(static_cast<double>(file_size(output))), "B, filled in ",
                    duration(fill_seconds), ", written in ", duration(writing.seconds())));
        return Ok{};
    }
#else
    Status run_sparse(const Scene&, const ProbeVolumeView&) {
        return Error{ErrorCode::Unsupported, "output", output,
                     output + ": cannot write (this program was built without OpenVDB)"};
    }
#endif
};

}  // namespace

Status run_lppv(const Values& values) {
    return LppvCommand(values).run();
}

}  // namespace tetralight::cli
