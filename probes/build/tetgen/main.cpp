// SPDX-License-Identifier: Apache-2.0
// Links TetGen (AGPL-3.0-or-later): the program `tetralight-tetgen` is distributed under that
// licence. Nothing else links TetGen; this source alone is Apache-2.0.
//
// Reads positions on stdin and writes their Delaunay tetrahedra on stdout, as stream.h says. TetGen
// can end its process with an assertion, which is why it has one of its own.
#include <tetgen.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <cstdio>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include <tetralight/probes/build/tetgen/stream.h>

namespace {

using namespace tetralight::tetgen;

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// TetGen counts coordinates and corners in ints; of a random set it makes 27 corners a position.
constexpr uint64_t kMaxPositions = INT_MAX / 32;

/// TetGen prints notes on stdout. They go to stderr, and what is written here to the real stdout.
File claim_stdout() {
    File file(::fdopen(::dup(STDOUT_FILENO), "wb"), &std::fclose);
    if (!file || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        throw std::runtime_error("cannot open stdout");
    }
    return file;
}

void read_positions(tetgenio& input) {
    StreamHeader header;
    if (std::fread(&header, sizeof header, 1, stdin) != 1 || header.magic != kPositionsMagic) {
        throw std::runtime_error("stdin holds no positions of this version");
    }
    if (header.count > kMaxPositions) throw std::runtime_error("too many positions for TetGen");
    const size_t coordinate_count = header.count * 3;
    input.numberofpoints = static_cast<int>(header.count);
    input.pointlist = new double[coordinate_count];  // tetgenio deletes it
    if (std::fread(input.pointlist, sizeof(double), coordinate_count, stdin) != coordinate_count) {
        throw std::runtime_error("stdin ends within the positions");
    }
}

const char* meaning_of(int tetgen_code) {
    switch (tetgen_code) {
        case 1:
            return "TetGen has not enough memory";
        case 2:
            return "TetGen found an error of its own";
        case 10:
            return "TetGen takes the positions for flat";
        default:
            return "TetGen failed";
    }
}

void tetrahedralize(tetgenio& input, tetgenio& output) {
    tetgenbehavior settings;
    settings.quiet = 1;
    settings.nojettison = 1;  // vertices keep their numbers
    settings.neighout = 1;
    settings.nobound = 1;
    // Predicates are exact; this is only what TetGen takes for flat as a whole.
    settings.epsilon = 1e-30;
    try {
        ::tetrahedralize(&settings, &input, &output);
    } catch (int code) {
        throw std::runtime_error(meaning_of(code));
    }
}

std::vector<StreamTetrahedron> tetrahedra_of(const tetgenio& output) {
    std::vector<StreamTetrahedron> tetrahedra(static_cast<size_t>(output.numberoftetrahedra));
    for (size_t i = 0; i < tetrahedra.size(); ++i) {
        StreamTetrahedron& tetrahedron = tetrahedra[i];
        std::copy_n(output.tetrahedronlist + 4 * i, 4, tetrahedron.vertices.begin());
        std::copy_n(output.neighborlist + 4 * i, 4, tetrahedron.neighbors.begin());  // −1: none
    }
    return tetrahedra;
}

void write_tetrahedra(std::FILE* file, const std::vector<StreamTetrahedron>& tetrahedra) {
    const StreamHeader header{kTetrahedraMagic, tetrahedra.size()};
    std::fwrite(&header, sizeof header, 1, file);
    std::fwrite(tetrahedra.data(), sizeof(StreamTetrahedron), tetrahedra.size(), file);
    if (std::fflush(file) != 0 || std::ferror(file) != 0) {
        throw std::runtime_error("cannot write to stdout");
    }
}

}  // namespace

int main() {
    try {
        const File out = claim_stdout();
        tetgenio input;
        tetgenio output;
        read_positions(input);
        tetrahedralize(input, output);
        write_tetrahedra(out.get(), tetrahedra_of(output));
        return 0;
    } catch (const std::bad_alloc&) {
        std::fputs("tetralight-tetgen: not enough memory\n", stderr);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "tetralight-tetgen: %s\n", error.what());
    }
    return 1;
}
