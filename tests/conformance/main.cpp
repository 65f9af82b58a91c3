// SPDX-License-Identifier: Apache-2.0
// Writes the conformance vectors into a folder, which must exist.
#include <cstdio>
#include <span>
#include <string>

#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include "tests/conformance/make_vectors.h"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: make_vectors FOLDER\n", stderr);
        return 2;
    }
    for (const auto& file : tetralight::conformance::make_vector_files()) {
        const std::string path = std::string(argv[1]) + "/" + file.name;
        const auto status = tetralight::write_file(path, file.bytes);
        if (!status) {
            std::fprintf(stderr, "%s\n", tetralight::error_text(status.error()).c_str());
            return 1;
        }
    }
    return 0;
}
