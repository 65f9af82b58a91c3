// SPDX-License-Identifier: Apache-2.0
// `query` between pipes, and with more positions than it may hold.
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "tests/cli/piped_command.h"
#include "tests/cli/query_fixture.h"

namespace tetralight::test {
namespace {

class QueryStream : public QueryFixture {
  protected:
    /// Writes `count` positions as a file of the format.
    void write_positions(const std::string& name, size_t count) const {
        const bool is_json = name.ends_with(".json");
        const bool is_raw = name.ends_with(".f32");
        std::ofstream stream(path(name), std::ios::binary);
        stream << (is_json ? "[[0,0,0]" : "");
        for (size_t i = is_json ? 1 : 0; i < count; ++i) {
            const size_t x = i % 8;
            const std::array<float, 3> position{static_cast<float>(x), 0.5f, 1.5f};
            if (is_raw) {
                stream.write(reinterpret_cast<const char*>(position.data()), sizeof position);
            } else {
                stream << (is_json ? ",\n[" : "") << x << (is_json ? ",0.5,1.5]" : " 0.5 1.5\n");
            }
        }
        stream << (is_json ? "]" : "");
    }

    [[nodiscard]] long peak_memory_kib(const std::string& name, size_t count,
                                       const char* format) const {
        write_positions(name, count);
        const CommandResult result =
            succeed({"query", "v.probes", name, "--to", format, "-o", "/dev/null", "--json"});
        EXPECT_EQ(Json::parse(result.out)["answers"], count);
        return result.peak_memory_kib;
    }
};

TEST_F(QueryStream, AnswersEachPositionBeforeTheNextComes) {
    const std::string first = raw(std::vector<glm::vec3>{{1, 1, 1}});
    const std::string second = raw(std::vector<glm::vec3>{{2, 1, 1}});
    const std::array<std::string, 3> kTalks[] = {{"text", "1 1 1\n", "2 1 1\n"},
                                                 {"jsonl", "[1,1,1]\n", "[2,1,1]\n"},
                                                 {"json", "[[1,1,1]", ",[2,1,1]"},
                                                 {"raw", first, second}};
    for (const auto& [format, one, two] : kTalks) {
        PipedCommand command(folder(), {"query", "v.probes", "--from", format});
        command.write(one);
        EXPECT_EQ(command.read().find("1 1 1: tetrahedron "), 0u) << format;
        command.write(two);
        EXPECT_EQ(command.read().find("2 1 1: tetrahedron "), 0u) << format;
        command.close_input();
        EXPECT_EQ(command.read(), "");
        EXPECT_EQ(WEXITSTATUS(command.wait()), format == "json" ? 1 : 0) << read("err");
    }
}

TEST_F(QueryStream, DoesNotMindWhereItsInputIsCut) {
    const auto positions = random_positions(300);
    const std::string whole = raw(positions);
    std::string out;
    PipedCommand command(folder(), {"query", "v.probes", "--from", "raw", "--to", "raw"});
    for (size_t begin = 0, size = 1; begin < whole.size(); begin += size, size = size % 100 + 7) {
        command.write(whole.substr(begin, size));
    }
    command.close_input();
    for (std::string part; !(part = command.read()).empty();) out += part;
    EXPECT_EQ(command.wait(), 0) << read("err");
    EXPECT_TRUE(out == succeed({"query", "v.probes", "--from", "raw", "--to", "raw"}, whole).out);
}

TEST_F(QueryStream, EndsQuietlyWhenNobodyReadsOn) {
    PipedCommand command(folder(), {"query", "v.probes"});
    command.close_output();
    command.write("1 1 1\n");
    const int status = command.wait();
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGPIPE) << status;
    EXPECT_EQ(read("err"), "");
}

TEST_F(QueryStream, SaysThatStdoutIsFull) {
    const std::string line = "cd " + folder().string() +
                             " && echo 1 1 1 | '" TETRALIGHT_COMMAND
                             "' query v.probes > /dev/full 2> err";
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 75);
    EXPECT_EQ(read("err"), "tetralight: stdout: cannot write (No space left on device)\n");
}

/// Answers to all of them would take hundreds of megabytes.
TEST_F(QueryStream, HoldsNoMoreForAMillionPositionsThanForSomeThousand) {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
    constexpr size_t kFew = 70'000;  // two chunks
    constexpr size_t kMany = 1'000'000;
    constexpr long kSlackKib = 16 * 1024;
    for (const auto& [name, format] :
         {std::pair{"p.f32", "raw"}, {"p.txt", "csv"}, {"p.json", "jsonl"}}) {
        const long few = peak_memory_kib(name, kFew, format);
        EXPECT_LT(peak_memory_kib(name, kMany, format), few + kSlackKib) << name;
    }
}

}  // namespace
}  // namespace tetralight::test
