// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/harness.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <utility>

namespace tetralight::bench {
namespace {

double rounded(double value) {
    return std::stod((std::ostringstream() << std::setprecision(4) << value).str());
}

}  // namespace

void run(const Contest& contest, const Options& options) {
    std::vector<double> ours;
    std::vector<double> baseline;
    for (int i = 0; i < options.repetitions; ++i) {
        ours.push_back(contest.work / contest.ours());
        baseline.push_back(contest.work / contest.baseline());
    }
    report_contest(contest.figure, median(ours), median(baseline), contest.unit,
                   contest.baseline_is);
}

void report_contest(const std::string& figure, double ours, double baseline,
                    const std::string& unit, const std::string& baseline_is) {
    const nlohmann::ordered_json line{{"figure", figure},
                                      {"ours", rounded(ours)},
                                      {"baseline", rounded(baseline)},
                                      {"unit", unit},
                                      {"ratio", rounded(ours / baseline)},
                                      {"baseline_is", baseline_is}};
    std::cout << line.dump() << std::endl;
}

void report(const std::string& figure, double value, const std::string& unit) {
    const nlohmann::ordered_json line{{"figure", figure}, {"ours", rounded(value)}, {"unit", unit}};
    std::cout << line.dump() << std::endl;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double cpu_seconds(const std::function<void()>& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool is_selected(const Options& options, const std::string& scene) {
    return options.only.value_or(scene) == scene;
}

double peak_memory(const std::vector<std::string>& arguments) {
    std::vector<char*> pointers{const_cast<char*>("tetralight_bench")};
    for (const std::string& argument : arguments) {
        pointers.push_back(const_cast<char*>(argument.c_str()));
    }
    pointers.push_back(nullptr);
    const pid_t child = fork();
    require(child >= 0, "fork");
    if (child == 0) {
        execv("/proc/self/exe", pointers.data());
        _exit(1);
    }
    rusage usage{};
    int status = 0;
    require(wait4(child, &status, 0, &usage) == child && status == 0, "a process of this program");
    return static_cast<double>(usage.ru_maxrss) * 1024.0;
}

void require(bool is_right, const std::string& what) {
    if (is_right) return;
    std::cerr << "tetralight_bench: wrong answer: " << what << '\n';
    std::exit(1);
}

std::vector<glm::dvec3> random_positions(size_t count, uint64_t seed, double extent) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> coordinate(0.0, extent);
    std::vector<glm::dvec3> positions;
    for (size_t i = 0; i < count; ++i) {
        const double x = coordinate(engine), y = coordinate(engine), z = coordinate(engine);
        positions.emplace_back(x, y, z);
    }
    return positions;
}

std::vector<glm::dvec3> lattice_positions(int side, double step) {
    std::vector<glm::dvec3> positions;
    for (int i = 0; i < side * side * side; ++i) {
        positions.push_back(step * glm::dvec3(i % side, i / side % side, i / side / side));
    }
    return positions;
}

glm::vec3 uniform_direction(glm::vec2 u) {
    const float z = 1.0f - 2.0f * u.x;
    const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float angle = 2.0f * std::numbers::pi_v<float> * u.y;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

ProbeGroup make_group(std::string name, std::vector<glm::dvec3> positions) {
    ProbeGroup group;
    group.name = std::move(name);
    group.positions = std::move(positions);
    return group;
}

}  // namespace tetralight::bench
