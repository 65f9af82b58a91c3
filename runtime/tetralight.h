// SPDX-License-Identifier: Apache-2.0
#ifndef TETRALIGHT_H
#define TETRALIGHT_H

#include <stddef.h>
#include <stdint.h>

/* The runtime for C, and for every language that can call C.
 *
 *     tetralight_error error;
 *     tetralight_volume* volume = NULL;
 *     if (tetralight_open("level.probes", &volume, &error) != TETRALIGHT_OK) {
 *         fprintf(stderr, "%s\n", error.message);
 *     }
 *     tetralight_light light;
 *     tetralight_query(volume, position, NULL, &light, &error);
 *     tetralight_close(volume);
 *
 * Every call gives TETRALIGHT_OK or a code, and a message in `error`, which may be NULL; it is
 * empty with TETRALIGHT_OK. A call that fails writes nothing else; what it was to write keeps its
 * value. NULL and pointers at odd addresses, wrong strides and short buffers are codes, never
 * crashes; that a pointer leads to memory that is there is the caller's promise. No exception
 * leaves a call.
 *
 * Memory: queries and packing allocate none. The calls that need much (recombine, fill_lppv,
 * make_shader_volume) ask for all of it first, and give TETRALIGHT_OUT_OF_MEMORY where the system
 * refuses. That does not hold for messages and the like (below 64 KiB a call), nor where a system
 * promises more memory than it has, nor where other threads take it meanwhile: then the program
 * ends.
 *
 * Threads: calls on different volumes are independent. Calls that take a `const` volume may run on
 * one volume at the same time. The others (recombine, close) need it for themselves.
 *
 * Space is right-handed, Y up, metres; light is linear Rec.709 (docs/conventions.md). */

#ifdef __cplusplus
#define TETRALIGHT_NOEXCEPT noexcept
extern "C" {
#else
#define TETRALIGHT_NOEXCEPT
#endif

typedef enum tetralight_status {
    TETRALIGHT_OK = 0,
    /** A pointer that is needed is NULL, or one is not aligned to its type. */
    TETRALIGHT_BAD_POINTER = 1,
    /** A stride or an enumerator that makes no sense, or a number that is not finite. */
    TETRALIGHT_BAD_VALUE = 2,
    /** A buffer is shorter than its count needs. */
    TETRALIGHT_SHORT_BUFFER = 3,
    /** The file cannot be opened or is no whole probe file. */
    TETRALIGHT_BAD_FILE = 4,
    /** The volume has not what is asked for. */
    TETRALIGHT_NOT_THERE = 5,
    /** The system has not as many bytes as the message says. */
    TETRALIGHT_OUT_OF_MEMORY = 6
} tetralight_status;

/** One line that says what was wrong and where; ends with '\0', cut off if it is longer. */
typedef struct tetralight_error {
    char message[512];
} tetralight_error;

/** An open probe volume. */
typedef struct tetralight_volume tetralight_volume;

/** What a volume holds. */
typedef struct tetralight_info {
    uint32_t probe_count;
    uint32_t cell_count;
    /** Cells from this one on lie outside of the hull of the probes. */
    uint32_t inner_cell_count;
    /** 0 none, 1 one probe, 2 probes on a line, 3 in a plane, 4 in space. */
    uint32_t dimension;
    /** Not zero: it has what its name says. */
    uint32_t has_light, has_occlusion;
    /** Layers that `tetralight_recombine` can weigh. */
    uint32_t layer_count;
} tetralight_info;

/** A layer of light: the sun, the sky, a lamp. */
typedef struct tetralight_layer {
    /** As "light:lamp", ends with '\0'; cut off if it is longer. */
    char name[128];
    /** What the volume's light has of it now; 1 = as it was baked. */
    float weight;
} tetralight_layer;

/** What is answered outside the hull of the probes (probes/locate.h). */
typedef enum tetralight_outside {
    TETRALIGHT_EXTRAPOLATE = 0,
    TETRALIGHT_CLAMP = 1,
    /** As clamp, fading to the volume's ambient light over `fade_distance`. */
    TETRALIGHT_AMBIENT = 2
} tetralight_outside;

/** How irradiance is written. */
typedef enum tetralight_sh_format {
    /** 27 floats: nine RGB coefficients, E(n) = sum of E_i Y_i(n). */
    TETRALIGHT_SH_COEFFICIENTS = 0,
    /** 28 floats: seven float4 for shaders, which evaluate to E(n) / pi. */
    TETRALIGHT_SH_PACKED = 1,
    /** 27 half floats, as the coefficients. */
    TETRALIGHT_SH_HALF = 2
} tetralight_sh_format;

/** No cell: a hint that asks to start at the nearest seed. */
#define TETRALIGHT_NO_CELL 0xffffffffu

/** The light at one position. */
typedef struct tetralight_light {
    /** As TETRALIGHT_SH_PACKED: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC. */
    float packed[28];
    /** Four channels, 1 = lit. */
    float occlusion[4];
    /** Barycentric weights of the cell's probes, >= 0. */
    float weights[4];
    /** The cell that holds the position, or TETRALIGHT_NO_CELL: the light is ambient. */
    uint32_t cell;
} tetralight_light;

/** An array of the caller's: element i begins at byte i * stride. */
typedef struct tetralight_array {
    void* data;
    /** Bytes from `data` to the end of the buffer. */
    size_t size;
    /** Bytes from element to element; 0 = no gap between elements. */
    size_t stride;
} tetralight_array;

/** The same, only read. */
typedef struct tetralight_const_array {
    const void* data;
    size_t size;
    size_t stride;
} tetralight_const_array;

/** Many positions in one call. Arrays whose `data` is NULL are left out. */
typedef struct tetralight_batch {
    size_t count;
    /** Three floats each, world space. */
    tetralight_const_array positions;
    /** uint32_t each, without gaps; in: where walks start, out: the cells found. May be NULL. */
    tetralight_array hints;
    tetralight_array sh;
    /** A tetralight_sh_format. */
    uint32_t sh_format;
    /** Four floats each. Of sh and occlusion one may be NULL. */
    tetralight_array occlusion;
    /** A tetralight_outside. */
    uint32_t outside;
    /** Metres, > 0; read where `outside` is TETRALIGHT_AMBIENT alone. */
    float fade_distance;
} tetralight_batch;

/** What a batch met. */
typedef struct tetralight_report {
    /** Positions that are not finite: their answer is the ambient light. */
    uint64_t not_finite_count;
    /** Cells that were tested. */
    uint64_t step_count;
} tetralight_report;

/** Instances as renderers upload them: the seven float4 in an array each. */
typedef struct tetralight_instances {
    size_t count;
    tetralight_const_array positions;
    tetralight_array hints;
    /** SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC: float4 each, without gaps. */
    tetralight_array sh[7];
    /** float4 each; may be NULL. */
    tetralight_array occlusion;
} tetralight_instances;

/** Opens a file and verifies all of it: for files from anywhere. `*volume` is to be closed. */
tetralight_status tetralight_open(const char* path, tetralight_volume** volume,
                                  tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Opens a file by its header and section table alone. A corrupt section gives wrong light or the
 * ambient light, never a read out of range; `tetralight_verify` finds it. */
tetralight_status tetralight_open_lazy(const char* path, tetralight_volume** volume,
                                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Does what `tetralight_open` adds to `tetralight_open_lazy`; for a background thread. */
tetralight_status tetralight_verify(const tetralight_volume* volume,
                                    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Closes a volume; NULL is fine. */
void tetralight_close(tetralight_volume* volume) TETRALIGHT_NOEXCEPT;

tetralight_status tetralight_get_info(const tetralight_volume* volume, tetralight_info* info,
                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

tetralight_status tetralight_get_layer(const tetralight_volume* volume, uint32_t index,
                                       tetralight_layer* layer,
                                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Makes the volume's light the sum of its layers times these weights, one a layer, >= 0. Not at
 * the same time as any other call on this volume. Cost: as reading all layers once; memory: that of
 * the probes' light. Shader volumes and proxy volumes that were made before keep their light. */
tetralight_status tetralight_recombine(tetralight_volume* volume, const float* weights,
                                       size_t weight_count,
                                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The light at one position (three floats). `hint`: the cell where the walk starts, and the cell
 * found; may be NULL. A position that is not finite gets the ambient light and no cell. */
tetralight_status tetralight_query(const tetralight_volume* volume, const float* position,
                                   uint32_t* hint, tetralight_light* light,
                                   tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The light at many positions. `report` may be NULL. */
tetralight_status tetralight_query_batch(const tetralight_volume* volume,
                                         const tetralight_batch* batch, tetralight_report* report,
                                         tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The light of instances. `report` may be NULL. */
tetralight_status tetralight_pack_instances(const tetralight_volume* volume,
                                            const tetralight_instances* instances,
                                            tetralight_report* report,
                                            tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** 27 coefficients of irradiance, all finite, as the 28 floats of TETRALIGHT_SH_PACKED.
 * Thread-safe.
 */
tetralight_status tetralight_pack_sh(const float* coefficients, float* packed,
                                     tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Irradiance / pi, three floats, of 28 packed floats at a unit normal, all finite: times albedo it
 * is the diffuse exitant radiance. Thread-safe. */
tetralight_status tetralight_sample_sh9(const float* packed, const float* normal, float* rgb,
                                        tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Which bands of the light vary within a proxy volume (lppv/lppv.h). */
typedef enum tetralight_lppv_quality {
    TETRALIGHT_LPPV_LOW = 0,
    TETRALIGHT_LPPV_NORMAL = 1,
    TETRALIGHT_LPPV_FULL = 2
} tetralight_lppv_quality;

/** Where in the box the grid points lie. */
typedef enum tetralight_lppv_placement {
    TETRALIGHT_LPPV_CELL_CORNERS = 0,
    TETRALIGHT_LPPV_CELL_CENTERS = 1
} tetralight_lppv_placement;

/** Parts of the texture along X (lppv/lppv_texture.h). */
typedef enum tetralight_lppv_layout {
    /** SHAr | SHAg | SHAb | occlusion; band 2 is the same for the whole object. */
    TETRALIGHT_LPPV_FOUR_SLABS = 0,
    /** SHAr | SHAg | SHAb | SHBr | SHBg | SHBb | SHC */
    TETRALIGHT_LPPV_SEVEN_SLABS = 1
} tetralight_lppv_layout;

/** RGBA texels of halves or floats. */
typedef enum tetralight_lppv_format {
    TETRALIGHT_LPPV_HALF = 0,
    TETRALIGHT_LPPV_FLOAT = 1
} tetralight_lppv_format;

/** A grid of light around a large object: a proxy volume. Its constants are to be finite floats. */
typedef struct tetralight_lppv_box {
    /** The object's transform, column by column. */
    float world_from_box[16];
    /** The box in the object's space. */
    float low[3], high[3];
    /** Grid points along each axis, 1 to 256. */
    uint32_t resolution[3];
    /** A tetralight_lppv_placement, _quality, _layout and _format. */
    uint32_t placement, quality, layout, format;
} tetralight_lppv_box;

/** The 3D texture of a proxy volume. */
typedef struct tetralight_lppv_size {
    uint32_t texels[3];
    size_t bytes;
} tetralight_lppv_size;

/** What shaders need beside the texture: LppvConstants of runtime/shaders/lppv.glsl. */
typedef struct tetralight_lppv_constants {
    float local_from_world[16];
    float params[4], low[4], size_inverse[4];
    float shb_r[4], shb_g[4], shb_b[4], shc[4];
} tetralight_lppv_constants;

/** Thread-safe. */
tetralight_status tetralight_get_lppv_size(const tetralight_lppv_box* box,
                                           tetralight_lppv_size* size,
                                           tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Fills a texture, x fastest, and its constants. Cost: one query a grid point; allocates. */
tetralight_status tetralight_fill_lppv(const tetralight_volume* volume,
                                       const tetralight_lppv_box* box,
                                       const tetralight_array* texels,
                                       tetralight_lppv_constants* constants,
                                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** A volume as shaders query it (runtime/shader_volume.h): arrays that are ready to upload. */
typedef struct tetralight_shader_volume tetralight_shader_volume;

/** In the order of their bindings: the uniform block, positions, light, cells, hull rays, seeds. */
#define TETRALIGHT_SHADER_ARRAY_COUNT 6

/** Makes them; `*made` is to be freed. It does not need the volume afterwards. */
tetralight_status tetralight_make_shader_volume(const tetralight_volume* volume,
                                                tetralight_shader_volume** made,
                                                tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** One of the arrays, valid until it is freed. None is empty. Thread-safe. */
tetralight_status tetralight_get_shader_array(const tetralight_shader_volume* made, uint32_t index,
                                              tetralight_const_array* array,
                                              tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Frees them; NULL is fine. */
void tetralight_free_shader_volume(tetralight_shader_volume* made) TETRALIGHT_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif
