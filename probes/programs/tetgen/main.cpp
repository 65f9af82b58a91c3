// SPDX-License-Identifier: Apache-2.0
// Links TetGen (AGPL-3.0-or-later): the program `tetralight-tetgen` is distributed under that
// licence. Nothing else links TetGen; this source alone is Apache-2.0.
//
// TetGen can end its process with an assertion, which is why it has one of its own.
#include <tetgen.h>

#include <algorithm>
#include <climits>
#include <stdexcept>

#include <tetralight/probes/programs/stream_io.h>

namespace {

using tetralight::programs::StreamTetrahedron;

/// TetGen counts coordinates and corners in ints; of a random set it makes 27 corners a position.
constexpr uint64_t kMostPositions = INT_MAX / 32;

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

std::vector<StreamTetrahedron> tetrahedra_over(std::vector<double> coordinates) {
    tetgenio input, output;
    input.numberofpoints = static_cast<int>(coordinates.size() / 3);
    input.pointlist = new double[coordinates.size()];  // tetgenio deletes it
    std::ranges::copy(coordinates, input.pointlist);
    tetrahedralize(input, output);
    std::vector<StreamTetrahedron> tetrahedra(static_cast<size_t>(output.numberoftetrahedra));
    for (size_t i = 0; i < tetrahedra.size(); ++i) {
        StreamTetrahedron& tetrahedron = tetrahedra[i];
        std::copy_n(output.tetrahedronlist + 4 * i, 4, tetrahedron.vertices.begin());
        std::copy_n(output.neighborlist + 4 * i, 4, tetrahedron.neighbors.begin());  // −1: none
    }
    return tetrahedra;
}

}  // namespace

int main() {
    return tetralight::programs::run_program("tetralight-tetgen", kMostPositions, tetrahedra_over);
}
