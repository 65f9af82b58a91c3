/* SPDX-License-Identifier: Apache-2.0 */
/* The C API from C99, as an engine calls it. Gives 0, or the number of the step that failed. */
#include "tests/runtime/c_api_consumer.h"

#include <math.h>
#include <string.h>

#include <tetralight/runtime/tetralight.h>

enum { kCount = 1023 };

typedef struct instance {
    float position[3];
    float padding;
    float light[28];
    float occlusion[4];
} instance;

static instance instances[kCount];
static uint32_t hints[kCount];
static float arrays[7][kCount][4];

static void place_instances(void) {
    int i;
    for (i = 0; i < kCount; ++i) {
        instances[i].position[0] = (float)(i % 11) * 0.3f - 1.0f;
        instances[i].position[1] = (float)(i / 11 % 11) * 0.3f - 1.0f;
        instances[i].position[2] = (float)(i / 121) * 0.3f - 1.0f;
        hints[i] = TETRALIGHT_NO_CELL;
    }
}

static int query_many(const tetralight_volume* volume) {
    tetralight_batch batch;
    tetralight_report report;
    memset(&batch, 0, sizeof batch);
    batch.count = kCount;
    batch.positions.data = instances[0].position;
    batch.positions.size = sizeof instances;
    batch.positions.stride = sizeof(instance);
    batch.hints.data = hints;
    batch.hints.size = sizeof hints;
    batch.sh.data = instances[0].light;
    batch.sh.size = sizeof instances - offsetof(instance, light);
    batch.sh.stride = sizeof(instance);
    batch.sh_format = TETRALIGHT_SH_PACKED;
    batch.occlusion.data = instances[0].occlusion;
    batch.occlusion.size = sizeof instances - offsetof(instance, occlusion);
    batch.occlusion.stride = sizeof(instance);
    return tetralight_query_batch(volume, &batch, &report, NULL) == TETRALIGHT_OK &&
           report.not_finite_count == 0 && report.step_count >= kCount;
}

static int pack_many(const tetralight_volume* volume) {
    tetralight_instances packed;
    int i;
    memset(&packed, 0, sizeof packed);
    packed.count = kCount;
    packed.positions.data = instances[0].position;
    packed.positions.size = sizeof instances;
    packed.positions.stride = sizeof(instance);
    for (i = 0; i < 7; ++i) {
        packed.sh[i].data = arrays[i];
        packed.sh[i].size = sizeof arrays[i];
    }
    return tetralight_pack_instances(volume, &packed, NULL, NULL) == TETRALIGHT_OK;
}

static int is_near(const float* a, const float* b, int count) {
    int i;
    for (i = 0; i < count; ++i) {
        if (!(fabsf(a[i] - b[i]) <= 1e-4f)) return 0;
    }
    return 1;
}

/** Single queries, the batch and the arrays are to say the same. */
static int compare(const tetralight_volume* volume) {
    tetralight_light light;
    int i, k;
    for (i = 0; i < kCount; ++i) {
        uint32_t hint = hints[i];
        if (tetralight_query(volume, instances[i].position, &hint, &light, NULL) != TETRALIGHT_OK) {
            return 0;
        }
        if (!is_near(light.packed, instances[i].light, 28)) return 0;
        if (!is_near(light.occlusion, instances[i].occlusion, 4)) return 0;
        for (k = 0; k < 7; ++k) {
            if (!is_near(light.packed + 4 * k, arrays[k][i], 4)) return 0;
        }
    }
    return 1;
}

/** The cells of the positions hold probes of the volume, whose box contains them. */
static int read_arrays(const tetralight_volume* volume, const tetralight_info* info) {
    tetralight_const_array cells, positions;
    tetralight_details details;
    uint32_t i, k;
    if (tetralight_get_array(volume, TETRALIGHT_ARRAY_CELL_VERTICES, &cells, NULL)) return 0;
    if (tetralight_get_array(volume, TETRALIGHT_ARRAY_POSITIONS, &positions, NULL)) return 0;
    if (tetralight_get_details(volume, &details, NULL)) return 0;
    if (positions.size != info->probe_count * positions.stride) return 0;
    for (i = 0; i < kCount; ++i) {
        const uint32_t* vertices =
            (const uint32_t*)((const char*)cells.data + hints[i] * cells.stride);
        const float* position =
            (const float*)((const char*)positions.data + vertices[0] * positions.stride);
        for (k = 0; k < 3; ++k) {
            const double place = details.world_origin[k] + position[k];
            if (place < details.low[k] || place > details.high[k]) return 0;
        }
    }
    return 1;
}

int run_c_api_consumer(const char* path) {
    const float up[3] = {0.0f, 1.0f, 0.0f};
    tetralight_error error;
    tetralight_volume* volume = NULL;
    tetralight_info info;
    float rgb[3];
    if (tetralight_open(path, &volume, &error) != TETRALIGHT_OK) return 1;
    if (tetralight_get_info(volume, &info, &error) != TETRALIGHT_OK) return 2;
    if (info.probe_count == 0 || info.dimension != 4) return 3;
    place_instances();
    if (!query_many(volume)) return 4;
    if (!pack_many(volume)) return 5;
    if (!compare(volume)) return 6;
    if (tetralight_sample_sh9(instances[0].light, up, rgb, &error) != TETRALIGHT_OK) return 7;
    if (!(rgb[0] == rgb[0])) return 8;
    if (!read_arrays(volume, &info)) return 9;
    tetralight_close(volume);
    return 0;
}
