// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/light_words.h>

namespace tetralight::cli {

const char* name_of(LightType type) {
    switch (type) {
        case LightType::Directional:
            return "directional";
        case LightType::Point:
            return "point";
        case LightType::Spot:
            return "spot";
        case LightType::Rectangle:
            return "rectangle";
        case LightType::Disc:
            return "disc";
    }
    return "unknown";
}

const char* name_of(LightMode mode) {
    switch (mode) {
        case LightMode::Mixed:
            return "mixed";
        case LightMode::Baked:
            return "baked";
        case LightMode::Realtime:
            return "realtime";
    }
    return "unknown";
}

}  // namespace tetralight::cli
