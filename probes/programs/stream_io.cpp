// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/programs/stream_io.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <new>
#include <stdexcept>

namespace tetralight::programs {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Libraries print notes on stdout. They go to stderr, and what is written here to the real stdout.
File claim_stdout() {
    File file(::fdopen(::dup(STDOUT_FILENO), "wb"), &std::fclose);
    if (!file || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        throw std::runtime_error("cannot open stdout");
    }
    return file;
}

std::vector<double> read_coordinates(uint64_t most) {
    StreamHeader header;
    if (std::fread(&header, sizeof header, 1, stdin) != 1 || header.magic != kPositionsMagic) {
        throw std::runtime_error("stdin holds no positions of this version");
    }
    if (header.count > most) throw std::runtime_error("too many positions");
    std::vector<double> coordinates;
    // Memory is taken as positions arrive: the header is not trusted.
    constexpr size_t kPiece = 3 << 16;
    for (size_t rest = header.count * 3; rest > 0;) {
        const size_t count = std::min(rest, kPiece);
        const size_t begin = coordinates.size();
        coordinates.resize(begin + count);
        if (std::fread(&coordinates[begin], sizeof(double), count, stdin) != count) {
            throw std::runtime_error("stdin ends within the positions");
        }
        rest -= count;
    }
    return coordinates;
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

int run_program(const char* name, uint64_t most, Tetrahedralize tetrahedralize) {
    try {
        const File out = claim_stdout();
        write_tetrahedra(out.get(), tetrahedralize(read_coordinates(most)));
        return 0;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: not enough memory\n", name);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
    }
    return 1;
}

}  // namespace tetralight::programs
