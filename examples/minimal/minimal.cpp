// SPDX-License-Identifier: Apache-2.0
// The light that arrives at one position of a baked volume: minimal FILE.probes X Y Z
#include <cstdio>
#include <cstdlib>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/packed_sh.h>
#include <tetralight/probes/probe_file.h>

int main(int argc, char** argv) {
    using namespace tetralight;
    if (argc != 5) return 2;
    const glm::vec3 position(std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4]));

    const auto file = open_probe_file(argv[1]);  // maps the file and verifies all of it
    if (!file) {
        std::fprintf(stderr, "%s\n", error_text(file.error()).c_str());
        return 1;
    }
    const CellLocation location = locate(file->view(), position);  // pass location.cell next time
    const PackedSh sh = pack_sh(interpolate(file->view(), location).irradiance);

    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const glm::vec3 light = sample_sh9(sh, up);  // irradiance / π: times albedo = radiance
    std::printf("%g %g %g\n", light.x, light.y, light.z);
    return 0;
}
