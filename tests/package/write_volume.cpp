// SPDX-License-Identifier: Apache-2.0
// Writes the volume that consumers of the package open: package_volume FILE
#include <cstdio>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/probe_file.h>
#include "tests/support/property_volume.h"

int main(int argc, char** argv) {
    using namespace tetralight;
    if (argc != 2) return 2;
    ProbeVolume volume = test::make_random_volume(test::random_positions(300, 1, 2.0), 2);
    // Brighter than it varies, so that it is positive at every normal.
    for (IrradianceSh& sh : volume.irradiance) sh.coefficients[0] += glm::vec3(20.0f);
    volume.occlusion.assign(volume.positions.size(), glm::vec4(0.5f, 1.0f, 0.0f, 1.0f));
    // Half of the light is a lamp's.
    volume.layers.resize(2);
    volume.layer_names = "light:lamp\nrest\n";
    for (Layer& layer : volume.layers) {
        layer.largest = 100.0f;
        for (const IrradianceSh& sh : volume.irradiance) {
            volume.layer_irradiance.push_back(sh * 0.5f);
        }
    }
    const auto status = write_probe_file(argv[1], volume.view());
    if (!status) std::fprintf(stderr, "%s\n", error_text(status.error()).c_str());
    return status ? 0 : 1;
}
