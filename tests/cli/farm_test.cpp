// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <tetralight/base/str_cat.h>
#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

/// Orders are read, cut into tasks, run and joined.
class Farm : public CommandFixture {
  protected:
    void order(const std::string& members) const {
        write("order.json", R"({"scenes": [{"scene": ")" + kCourtyard + R"(", )" + members + "}]}");
    }

    /// A cheap bake of all kinds of light but cubes.
    void cheap_order() const {
        order(R"("probes": {"samples": 16},
                 "lightmaps": {"samples": 16, "texels_per_meter": 1}})"
              R"(, {"scene": ")" +
              kCourtyard + R"(", "name": "again", "probes": {"samples": 16, "seed": 1})");
    }

    /// Runs all tasks in an order that phases allow.
    void run_tasks() const {
        const Json plan = Json::parse(read("job/plan.json"));
        for (size_t task = 0; task < plan["tasks"].size(); ++task)
            succeed({"task", "job", std::to_string(task), "-q"});
    }
};

TEST_F(Farm, TasksGiveTheBytesOfOneBake) {
    cheap_order();
    succeed({"plan", "order.json", "--tasks", "3", "-o", "job"});
    run_tasks();
    succeed({"collect", "job", "-o", "baked"});
    succeed({"bake", kCourtyard, "-s", "16", "-o", "one.probes", "-q"});
    succeed({"lightmap", kCourtyard, "-s", "16", "--texels-per-meter", "1", "-o", "one.lightmaps",
             "-q"});
    EXPECT_TRUE(read("baked/courtyard.probes") == read("one.probes"));
    EXPECT_TRUE(read("baked/courtyard.lightmaps") == read("one.lightmaps"));
    EXPECT_FALSE(read("baked/again.probes") == read("one.probes"));
}

TEST_F(Farm, ATaskThatIsDoneIsNotRunAgain) {
    order(R"("probes": {"samples": 16})");
    succeed({"plan", "order.json", "--tasks", "2", "-o", "job"});
    EXPECT_EQ(run_json({"task", "job", "0"})["was_done"], false);
    EXPECT_EQ(run_json({"task", "job", "0"})["was_done"], true);
    EXPECT_EQ(run_json({"plan", "order.json", "--tasks", "2", "-o", "job"})["done"], 1);
    order(R"("probes": {"samples": 17})");
    EXPECT_EQ(run_json({"plan", "order.json", "--tasks", "2", "-o", "job"})["done"], 0);
}

TEST_F(Farm, MissingTasksAreNamedAndMeanTryAgain) {
    order(R"("probes": {"samples": 16})");
    succeed({"plan", "order.json", "--tasks", "3", "-o", "job"});
    succeed({"task", "job", "1", "-q"});
    EXPECT_TRUE(contains(fail({"collect", "job"}, "", 75),
                         "courtyard: probes: 2 of 3 tasks are not done: 0, 2"));
}

TEST_F(Farm, PartsThatAreDamagedAreNamed) {
    order(R"("probes": {"samples": 16})");
    succeed({"plan", "order.json", "--tasks", "2", "-o", "job"});
    run_tasks();
    const std::string name = "parts/courtyard.probes.00001.part", part = read("job/" + name);
    write("job/" + name, part.substr(0, 100));
    EXPECT_TRUE(contains(fail({"collect", "job"}, "", 75),
                         str_cat("1 of 2 tasks is not done: 1; ", name,
                                 " has 100 bytes, and task 1 wrote ", part.size(), " bytes")));
    std::string damaged = part;
    damaged[damaged.size() / 2] ^= 1;
    write("job/" + name, damaged);
    const std::string line = fail({"collect", "job"});
    EXPECT_TRUE(contains(line, "courtyard: probes: " + name)) << line;
    EXPECT_TRUE(contains(line, "delete a part that is damaged")) << line;
    std::filesystem::remove(path("job/" + name));
    succeed({"task", "job", "1", "-q"});
    succeed({"collect", "job", "-q"});
}

TEST_F(Farm, WhatIsWholeIsCollectedAndTheRestReported) {
    cheap_order();
    succeed({"plan", "order.json", "--tasks", "1", "-o", "job"});
    run_tasks();
    std::filesystem::remove(path("job/parts/courtyard.probes.00000.part"));
    const CommandResult result = run({"collect", "job", "-o", "baked"});
    EXPECT_EQ(result.exit_code, 75);
    EXPECT_TRUE(contains(result.out, "again.probes: "));
    EXPECT_TRUE(contains(result.err, "courtyard: probes: 1 of 1 task is not done: 0"));
    EXPECT_FALSE(std::filesystem::exists(path("baked/courtyard.probes")));
    EXPECT_TRUE(std::filesystem::exists(path("baked/courtyard.lightmaps")));
    EXPECT_TRUE(std::filesystem::exists(path("baked/again.probes")));
    const Json report = Json::parse(read("baked/report.json"));
    EXPECT_FALSE(report["passed"].get<bool>());
    EXPECT_TRUE(contains(report["scenes"][0]["error"].get<std::string>(), "is not done"));
    EXPECT_TRUE(report["scenes"][1]["passed"].get<bool>());
}

TEST_F(Farm, OutputsThatWereChangedAreWrittenAgain) {
    order(R"("probes": {"samples": 16})");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    const std::string file = "baked/courtyard.probes", first = read(file);
    std::string damaged = first;
    damaged[damaged.size() / 2] ^= 1;
    write(file, damaged);
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    EXPECT_TRUE(read(file) == first);
}

TEST_F(Farm, AnotherCutSaysThatFinishedTasksAreLost) {
    order(R"("probes": {"samples": 16})");
    succeed({"plan", "order.json", "--tasks", "3", "-o", "job"});
    succeed({"task", "job", "1", "-q"});
    EXPECT_TRUE(contains(run({"plan", "order.json", "--tasks", "2", "-o", "job"}).err,
                         "removed the results of 1 finished task"));
}

TEST_F(Farm, PlansCannotWriteOutsideTheirFolders) {
    order(R"("probes": {"samples": 16})");
    succeed({"plan", "order.json", "--tasks", "1", "-o", "job"});
    const Json plan = Json::parse(read("job/plan.json"));
    const auto refused = [&](const char* place, const char* value) {
        Json changed = plan;
        changed[Json::json_pointer(place)] = value;
        write("job/plan.json", changed.dump());
        return fail({"collect", "job"});
    };
    for (const char* file : {"../evil.probes", "/evil.probes", ".hidden", ""})
        EXPECT_TRUE(contains(refused("/results/0/file", file), "results[0].file")) << file;
    EXPECT_TRUE(contains(refused("/results/0/key", "../x"), "results[0].key"));
    EXPECT_TRUE(contains(refused("/tasks/0/key", "../x"), "tasks[0].key"));
    for (const char* output : {"/x.part", "parts/../../x.part"})
        EXPECT_TRUE(contains(refused("/tasks/0/command/output", output), "tasks[0].command.output"))
            << output;
}

TEST_F(Farm, FoldersThatAreFilesStayWrong) {
    order(R"("probes": {"samples": 16})");
    EXPECT_TRUE(contains(fail({"plan", "order.json", "-o", "order.json"}), "cannot be made"));
}

TEST_F(Farm, ScenesThatCannotBeReadAreNamedByTheirPlace) {
    write("order.json", R"({"scenes": [{"scene": "nothing.glb", "probes": {}}]})");
    EXPECT_TRUE(
        contains(fail({"plan", "order.json", "-o", "job"}), "order.json: scenes[0].probes: "));
}

TEST_F(Farm, LaterPhasesWaitForEarlierOnes) {
    order(R"("lightmaps": {"samples": 16, "texels_per_meter": 1})");
    succeed({"plan", "order.json", "--tasks", "2", "-o", "job"});
    EXPECT_TRUE(contains(fail({"task", "job", "1"}, "", 75), "1 of 1 task is not done: 0"));
}

TEST_F(Farm, OrdersThatAreWrongAreRefusedByTheirMember) {
    const auto refused = [&](const std::string& members, const std::string& reason) {
        order(members);
        EXPECT_TRUE(contains(fail({"plan", "order.json", "-o", "job"}), reason)) << reason;
    };
    refused(R"("probes": {"samples": "x"})", "order.json: scenes[0].probes: samples");
    refused(R"("probes": {"output": "x.probes"})", "output");
    refused(R"("probs": {})", "order.json: scenes[0]: asks for nothing");
    refused(R"("probes": {}, "lightmap": {})", R"(lightmap: there is no such member)");
    refused(R"("name": "a/b", "probes": {})", R"("a/b" cannot begin the name of a file)");
    refused(R"("probes": {}}, {"scene": "courtyard.glb", "probes": {})",
            "is the name of an earlier scene");
    refused(R"("probes": {}, "limits": {"error": 2})", "order.json: scenes[0]: limits: error");
    refused(R"("probes": {}, "limits": {"eror": 1})", "eror");
    EXPECT_TRUE(contains(fail({"task", "nothing", "0"}), "is not a job"));
}

TEST_F(Farm, LimitsPassOrFailInOneReport) {
    write("order.json", R"({"limits": {"dead_probes": 1.0}, "scenes": [
        {"scene": ")" + kCourtyard +
                            R"(", "name": "kept", "probes": {"samples": 32},
         "limits": {"error": 1, "leak": "100%", "seconds": "1h"}},
        {"scene": ")" + kCourtyard +
                            R"(", "name": "<missed>", "probes": {"samples": 32},
         "lightmaps": {"samples": 32, "texels_per_meter": 1},
         "limits": {"error": "0.01%", "dead_probes": "100%"}}]})");
    const CommandResult result = run({"bake-all", "order.json", "-o", "baked", "--json"});
    EXPECT_EQ(result.exit_code, 1);
    const Json report = Json::parse(read("baked/report.json"));
    EXPECT_FALSE(report["passed"].get<bool>());
    const Json kept = report["scenes"][0], missed = report["scenes"][1];
    EXPECT_TRUE(kept["passed"].get<bool>());
    EXPECT_FALSE(missed["passed"].get<bool>());
    const auto value = [](const Json& scene, const std::string& name) {
        for (const Json& check : scene["limits"])
            if (check["name"] == name) return check["value"].get<double>();
        return -1.0;
    };
    // The same figures as the commands themselves report.
    const Json bake = run_json({"bake", kCourtyard, "-s", "32", "-o", "one.probes"});
    EXPECT_EQ(value(kept, "error of probes"), bake["standard_error"]["p99"].get<double>());
    EXPECT_EQ(value(kept, "dead_probes of probes"),
              bake["dilated"].get<double>() / bake["probes"].get<double>());
    EXPECT_EQ(kept["rays"], bake["rays"]);
    const Json leaks = run_json({"check-leaks", "one.probes", "--scene", kCourtyard});
    EXPECT_EQ(value(kept, "leak of probes"), leaks["through_walls"]["mean"].get<double>());
    EXPECT_GT(value(kept, "seconds"), 0.0);
    EXPECT_EQ(missed["limits"].size(), 3u);  // errors of two kinds, and dead probes
    const std::string junit = read("baked/report.xml");
    EXPECT_TRUE(contains(junit, R"(<testsuite name="&lt;missed&gt;" tests="5" failures="2")"));
    EXPECT_TRUE(contains(junit, R"(<failure message="error of probes is 0.)"));
    EXPECT_TRUE(contains(junit, R"(, more than 0.0001")"));
}

TEST_F(Farm, BakeAllBakesWhatChanged) {
    order(R"("probes": {"samples": 16})");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    const std::string first = read("baked/courtyard.probes");
    succeed({"bake", kCourtyard, "-s", "16", "-o", "one.probes", "-q"});
    EXPECT_TRUE(first == read("one.probes"));
    EXPECT_TRUE(contains(succeed({"bake-all", "order.json", "-o", "baked"}).out, "unchanged"));
    EXPECT_TRUE(read("baked/courtyard.probes") == first);
}

/// A lamp and the sky over five probes.
class FarmOfALamp : public Farm {
  protected:
    void scene(const std::string& lamp) const {
        write("scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [
                {"type": "point", "name": "lamp", "extras": {"mode": "baked"}, )" +
                                lamp + R"(}]}},
            "nodes": [{"name": "lamp", "translation": [1, 2, 3],
                "extensions": {"KHR_lights_punctual": {"light": 0}}}]})");
    }

    void order_of_lamp() const {
        write("groups.json", kFiveProbes);
        write("order.json", R"({"scenes": [{"scene": "scene.gltf", "sky": 0.5, "probes": {
            "samples": 64, "groups": ["groups.json"], "layers": ["light:lamp"]}}]})");
    }

    /// The light that answers at a position.
    [[nodiscard]] std::vector<double> light(const std::string& volume) const {
        const Json answer = Json::parse(succeed({"query", volume, "--to", "jsonl"}, "1 1 1\n").out);
        std::vector<double> values;
        for (const Json& value : answer.flatten())
            if (value.is_number()) values.push_back(value.get<double>());
        return values;
    }

    [[nodiscard]] size_t task_count() const {
        return Json::parse(read("baked/job/plan.json"))["tasks"].size();
    }
};

TEST_F(FarmOfALamp, AStrongerLampOfItsOwnLayerIsNotBakedAgain) {
    order_of_lamp();
    scene(R"("intensity": 100)");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    EXPECT_EQ(task_count(), 1u);
    const std::string first = read("baked/scene.probes");
    for (const char* intensity : {"130", "7"}) {
        scene(str_cat(R"("intensity": )", intensity));
        succeed({"bake-all", "order.json", "-o", "baked", "-q"});
        EXPECT_EQ(task_count(), 0u);
        succeed({"bake", "scene.gltf", "--sky", "0.5", "-s", "64", "--groups", "groups.json",
                 "--layers", "light:lamp", "-o", "one.probes", "-q"});
        const std::vector<double> relit = light("baked/scene.probes"), baked = light("one.probes");
        ASSERT_EQ(relit.size(), baked.size());
        const double largest = *std::ranges::max_element(baked);
        for (size_t i = 0; i < relit.size(); ++i)
            EXPECT_NEAR(relit[i], baked[i], 1e-3 * largest) << i;
    }
    EXPECT_TRUE(contains(succeed({"bake-all", "order.json", "-o", "baked"}).out, "unchanged"));
    std::filesystem::remove(path("baked/scene.probes"));
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    EXPECT_EQ(task_count(), 0u);
    scene(R"("intensity": 100)");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    EXPECT_EQ(light("baked/scene.probes"), [&] {
        write("first.probes", first);
        return light("first.probes");
    }());
}

TEST_F(FarmOfALamp, LimitsAreKeptByTheSameLightWithOtherWeights) {
    order_of_lamp();
    Json order = Json::parse(read("order.json"));
    order["limits"] = {{"error", "90%"}, {"dead_probes", "10%"}};
    write("order.json", order.dump());
    scene(R"("intensity": 100)");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    scene(R"("intensity": 300)");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    EXPECT_EQ(task_count(), 0u);
    const Json scene = Json::parse(read("baked/report.json"))["scenes"][0];
    // As the volume itself says.
    const Json info = run_json({"info", "baked/scene.probes"});
    for (const Json& check : scene["limits"]) {
        const bool is_error = check["name"] == "error of probes";
        EXPECT_EQ(check["value"], is_error ? info["standard_error"]["p99"] : Json(0.0));
    }
}

TEST_F(FarmOfALamp, AnotherColorIsBaked) {
    order_of_lamp();
    scene(R"("intensity": 100)");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    scene(R"("intensity": 100, "color": [1, 0.5, 0.5])");
    succeed({"bake-all", "order.json", "-o", "baked", "-q"});
    EXPECT_EQ(task_count(), 1u);
}

}  // namespace
}  // namespace tetralight::test
