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
 * Errors: every call returns a status. `error` receives a message, empty with TETRALIGHT_OK; it may
 * be NULL. A call that fails leaves its outputs unchanged. NULL, misaligned pointers, wrong strides
 * and short buffers are reported as statuses. The caller guarantees that every other pointer leads
 * to memory of the size that it states. No exception leaves a call.
 *
 * Memory: queries and packing do not allocate. The calls that need much memory (open_memory,
 * recombine, relight, save, fill_lppv, make_shader_volume) first ask for all of it, and return
 * TETRALIGHT_OUT_OF_MEMORY if the system refuses. The program still ends in three cases: if a
 * message or another small piece (below 64 KiB a call) cannot be allocated, if the system promises
 * more memory than it has, and if another thread takes the memory in between
 * (docs/decisions/0037-memory-through-the-c-api.md).
 *
 * Threads: calls on different volumes are independent. Calls that take a `const` volume may run on
 * one volume at the same time. The others (recombine, relight, close) must run alone on their
 * volume.
 *
 * Space is right-handed, Y up, in metres; light is linear Rec.709 (docs/conventions.md). */

/* The version of this header. `tetralight_version` has that of the library. */
#define TETRALIGHT_VERSION_MAJOR 0
#define TETRALIGHT_VERSION_MINOR 2
#define TETRALIGHT_VERSION_PATCH 0
#define TETRALIGHT_VERSION_STRING "0.2.0"
#define TETRALIGHT_VERSION_NUMBER \
    (TETRALIGHT_VERSION_MAJOR * 10000 + TETRALIGHT_VERSION_MINOR * 100 + TETRALIGHT_VERSION_PATCH)

/* Marks the functions of the C API. Define TETRALIGHT_SHARED in programs that use the shared
 * library; those that link the static libraries need nothing. Where a shared library of one's own
 * is built from the sources, define TETRALIGHT_BUILDING_SHARED too. */
#if !defined(TETRALIGHT_SHARED)
#define TETRALIGHT_API
#elif defined(_WIN32) && defined(TETRALIGHT_BUILDING_SHARED)
#define TETRALIGHT_API __declspec(dllexport)
#elif defined(_WIN32)
#define TETRALIGHT_API __declspec(dllimport)
#else
#define TETRALIGHT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
#define TETRALIGHT_NOEXCEPT noexcept
extern "C" {
#else
#define TETRALIGHT_NOEXCEPT
#endif

typedef enum tetralight_status {
    TETRALIGHT_OK = 0,
    /** A required pointer is NULL, or a pointer is not aligned to its type. */
    TETRALIGHT_BAD_POINTER = 1,
    /** A stride, an enumerator or a number is out of range, or a number is not finite. */
    TETRALIGHT_BAD_VALUE = 2,
    /** A buffer is too short for its count. */
    TETRALIGHT_SHORT_BUFFER = 3,
    /** There is no such file, or the path does not lead to a regular file. */
    TETRALIGHT_BAD_FILE = 4,
    /** The volume, the lightmaps or the reflection probes do not contain the requested item. */
    TETRALIGHT_NOT_THERE = 5,
    /** The system refuses the number of bytes that the message gives. */
    TETRALIGHT_OUT_OF_MEMORY = 6,
    /** The bytes of the file are wrong: opening it again fails again. */
    TETRALIGHT_CORRUPT = 7,
    /** This version of the library cannot read a file that is valid, or save joined volumes. */
    TETRALIGHT_UNSUPPORTED = 8,
    /** The file cannot be read now (I/O error, permissions, network): try again later. */
    TETRALIGHT_UNAVAILABLE = 9,
    /** Memory or file descriptors are used up: try again later. */
    TETRALIGHT_OUT_OF_RESOURCES = 10,
    /** There is no space left for a file that is written. */
    TETRALIGHT_DISK_FULL = 11,
    /** The caller stopped the work. */
    TETRALIGHT_CANCELLED = 12
} tetralight_status;

/** One line that says what is wrong and where, ends with '\0'; a longer message is truncated. */
typedef struct tetralight_error {
    char message[512];
} tetralight_error;

/** An open probe volume. */
typedef struct tetralight_volume tetralight_volume;

/** The contents of a volume. */
typedef struct tetralight_info {
    uint32_t probe_count;
    uint32_t cell_count;
    /** Cells with this index or a higher one lie outside the hull of the probes. */
    uint32_t inner_cell_count;
    /** 0 none, 1 one probe, 2 probes on a line, 3 in a plane, 4 in space. */
    uint32_t dimension;
    /** 1 if the volume has baked light and occlusion, else 0. */
    uint32_t has_light, has_occlusion;
    /** Number of layers, and of weights that `tetralight_recombine` takes. */
    uint32_t layer_count;
} tetralight_info;

/** A layer of light: the sun, the sky, a light of the scene. */
typedef struct tetralight_layer {
    /** For example "light:lamp", ends with '\0'; a longer name is truncated. */
    char name[128];
    /** Its weight in the volume's light; 1 = as baked. */
    float weight;
} tetralight_layer;

/** The light outside the hull of the probes (probes/locate.h). */
typedef enum tetralight_outside {
    TETRALIGHT_EXTRAPOLATE = 0,
    TETRALIGHT_CLAMP = 1,
    /** As clamp, fading to the ambient light of the volume over `fade_distance`. */
    TETRALIGHT_AMBIENT = 2
} tetralight_outside;

/** Whether walls of the scene hide probes behind them (probes/edge_visibility.h). A volume that
 * knows no walls gives the same light with both. */
typedef enum tetralight_walls {
    TETRALIGHT_HIDE_PROBES = 0,
    TETRALIGHT_IGNORE_WALLS = 1
} tetralight_walls;

/** The format of irradiance in an array. */
typedef enum tetralight_sh_format {
    /** 27 floats: nine RGB coefficients, E(n) = sum of E_i Y_i(n). */
    TETRALIGHT_SH_COEFFICIENTS = 0,
    /** 28 floats: seven float4 for shaders, which evaluate E(n) / pi from them. */
    TETRALIGHT_SH_PACKED = 1,
    /** 27 half floats: the same coefficients. */
    TETRALIGHT_SH_HALF = 2
} tetralight_sh_format;

/** No cell. As a hint: the search starts at the nearest seed. */
#define TETRALIGHT_NO_CELL 0xffffffffu

/** A good share for `tetralight_batch.normal_offset` (probes/receiver.h). */
#define TETRALIGHT_NORMAL_OFFSET 0.1f

/** The light at one position. */
typedef struct tetralight_light {
    /** As TETRALIGHT_SH_PACKED: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC. */
    float packed[28];
    /** Four channels, 1 = lit. */
    float occlusion[4];
    /** Barycentric weights of the cell's probes, >= 0; they sum to 1. Walls do not change them. */
    float weights[4];
    /** The cell that contains the position, or TETRALIGHT_NO_CELL if the light is ambient. */
    uint32_t cell;
} tetralight_light;

/** An array of the caller. Element i begins at byte i * stride. */
typedef struct tetralight_array {
    void* data;
    /** Bytes from `data` to the end of the buffer. */
    size_t size;
    /** Bytes from one element to the next; 0 = elements without gaps. */
    size_t stride;
} tetralight_array;

/** The same for an array that is only read. */
typedef struct tetralight_const_array {
    const void* data;
    size_t size;
    size_t stride;
} tetralight_const_array;

/** Many positions in one call. An array whose `data` is NULL is not written. */
typedef struct tetralight_batch {
    size_t count;
    /** Three floats each, world space. */
    tetralight_const_array positions;
    /** uint32_t each, without gaps. In: the cells where searches start. Out: the cells found. May
     * be NULL. */
    tetralight_array hints;
    tetralight_array sh;
    /** A tetralight_sh_format. */
    uint32_t sh_format;
    /** Four floats each. Either `sh` or `occlusion` may be NULL. */
    tetralight_array occlusion;
    /** A tetralight_outside. */
    uint32_t outside;
    /** Metres, > 0; read only if `outside` is TETRALIGHT_AMBIENT. */
    float fade_distance;
    /** A tetralight_walls. */
    uint32_t walls;
    /** uint32_t each, without gaps; bit i: what is lit is on rendering layer i, and probes on none
     * of its layers do not light it. NULL or 0 = all layers. */
    tetralight_const_array rendering_layers;
    /** float each, without gaps, metres, >= 0: light of probes behind a wall fades over this
     * distance. NULL = 0. */
    tetralight_const_array radii;
    /** Three floats each, without gaps: unit normals of surfaces that the positions lie on, along
     * which they are pushed off. Such a batch takes about twice the time. May be NULL. */
    tetralight_const_array normals;
    /** The share of the mean distance to the probes that positions with normals are pushed by, >=
     * 0; TETRALIGHT_NORMAL_OFFSET is a good one. */
    float normal_offset;
} tetralight_batch;

/** Counts of a batch. */
typedef struct tetralight_report {
    /** Positions that are not finite; they receive the ambient light. */
    uint64_t not_finite_count;
    /** Cells that the searches tested. */
    uint64_t step_count;
} tetralight_report;

/** Instances as renderers upload them: one array for each of the seven float4. */
typedef struct tetralight_instances {
    size_t count;
    tetralight_const_array positions;
    tetralight_array hints;
    /** SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC: float4 each, without gaps. */
    tetralight_array sh[7];
    /** float4 each; may be NULL. */
    tetralight_array occlusion;
    /** As in tetralight_batch. */
    uint32_t walls;
    tetralight_const_array rendering_layers;
    tetralight_const_array radii;
} tetralight_instances;

/** The version of the library: major * 10000 + minor * 100 + patch. Thread-safe. */
TETRALIGHT_API uint32_t tetralight_version(void) TETRALIGHT_NOEXCEPT;

/** The same as text, for example "0.1.0". Thread-safe. */
TETRALIGHT_API const char* tetralight_version_string(void) TETRALIGHT_NOEXCEPT;

/** Opens a file and verifies all of it: for files from any source. Close `*volume` after use. */
TETRALIGHT_API tetralight_status tetralight_open(const char* path, tetralight_volume** volume,
                                                 tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Opens a file and checks only its header and section table. A corrupt section gives wrong light
 * or the ambient light, never a read out of range; `tetralight_verify` finds it. */
TETRALIGHT_API tetralight_status tetralight_open_lazy(const char* path, tetralight_volume** volume,
                                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Opens a file that is in memory: of an archive or an asset bundle, from a network. Copies the
 * bytes, so that they may change or go after the call, and verifies all of them. `bytes` need not
 * be aligned. Messages begin with "memory". Close `*volume` after use. */
TETRALIGHT_API tetralight_status
tetralight_open_memory(const void* bytes, size_t size, tetralight_volume** volume,
                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Verifies all of a volume that `tetralight_open_lazy` has opened; for a background thread. */
TETRALIGHT_API tetralight_status tetralight_verify(const tetralight_volume* volume,
                                                   tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Closes a volume; does nothing if it is NULL. */
TETRALIGHT_API void tetralight_close(tetralight_volume* volume) TETRALIGHT_NOEXCEPT;

TETRALIGHT_API tetralight_status tetralight_get_info(const tetralight_volume* volume,
                                                     tetralight_info* info,
                                                     tetralight_error* error) TETRALIGHT_NOEXCEPT;

TETRALIGHT_API tetralight_status tetralight_get_layer(const tetralight_volume* volume,
                                                      uint32_t index, tetralight_layer* layer,
                                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The arrays of a volume. */
typedef enum tetralight_volume_array {
    /** Three floats a probe, relative to `tetralight_details.world_origin`. */
    TETRALIGHT_ARRAY_POSITIONS = 0,
    /** Three doubles a probe: the world positions that were tetrahedralized. */
    TETRALIGHT_ARRAY_EXACT_POSITIONS = 1,
    /** 27 floats a probe: TETRALIGHT_SH_COEFFICIENTS. */
    TETRALIGHT_ARRAY_IRRADIANCE = 2,
    /** 32 halves a probe: 27 coefficients divided by `tetralight_details.half_scale`, four of
     * occlusion, validity. Queries read these if they are there. */
    TETRALIGHT_ARRAY_HALVES = 3,
    /** Four floats a probe, 1 = lit. */
    TETRALIGHT_ARRAY_OCCLUSION = 4,
    /** One float a probe: the fraction of its rays that hit no back face. */
    TETRALIGHT_ARRAY_VALIDITY = 5,
    /** One float a probe: the relative standard error of its irradiance; 0 = not known. */
    TETRALIGHT_ARRAY_STANDARD_ERROR = 6,
    /** One float a probe: metres to the nearest surface; can be infinite. */
    TETRALIGHT_ARRAY_SURFACE_DISTANCE = 7,
    /** Three floats a probe, metres: from the probe to where its rays start. */
    TETRALIGHT_ARRAY_VIRTUAL_OFFSET = 8,
    /** One uint32_t a probe. Not 0: its light is that of the valid probes around it. */
    TETRALIGHT_ARRAY_DILATED = 9,
    /** One uint32_t a probe, bit i: it lights objects on rendering layer i. */
    TETRALIGHT_ARRAY_RENDERING_LAYERS = 10,
    /** Four uint32_t a cell: its probes, TETRALIGHT_NO_CELL in unused places. */
    TETRALIGHT_ARRAY_CELL_VERTICES = 11,
    /** Four uint32_t a cell: the cell opposite each of its vertices. */
    TETRALIGHT_ARRAY_CELL_NEIGHBORS = 12,
    /** Nine floats a cell outside the hull: the unit rays along which its vertices extend. */
    TETRALIGHT_ARRAY_HULL_RAYS = 13,
    /** Three uint32_t a source: group, index in the group, probe or TETRALIGHT_NO_CELL. */
    TETRALIGHT_ARRAY_SOURCES = 14,
    /** 27 floats a probe, layer after layer, at weight 1. */
    TETRALIGHT_ARRAY_LAYER_IRRADIANCE = 15,
    /** One float a probe, layer after layer: the relative standard error; 0 = not known. */
    TETRALIGHT_ARRAY_LAYER_ERRORS = 16,
    /** 48 floats: the sky, as `tetralight_relight_sky` takes it. */
    TETRALIGHT_ARRAY_SKY = 17,
    /** Text, one name a line, each ended by a line feed. */
    TETRALIGHT_ARRAY_GROUP_NAMES = 18,
    TETRALIGHT_ARRAY_LIGHT_NAMES = 19,
    TETRALIGHT_ARRAY_LAYER_NAMES = 20,
    /** Text: how the volume was made, a JSON object. */
    TETRALIGHT_ARRAY_METADATA = 21
} tetralight_volume_array;

/** An array of a volume without a copy, `which` a tetralight_volume_array. `stride` is not 0.
 * Valid until a call that changes the volume (recombine, relight, close; of joined volumes commit
 * and destroy).
 * Returns TETRALIGHT_NOT_THERE if the array is empty: files can hold light as floats, as halves or
 * both. */
TETRALIGHT_API tetralight_status tetralight_get_array(const tetralight_volume* volume,
                                                      uint32_t which, tetralight_const_array* array,
                                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** More about a volume. */
typedef struct tetralight_details {
    /** The world position that TETRALIGHT_ARRAY_POSITIONS are relative to. */
    double world_origin[3];
    /** The box of the probes, world space; all 0 without probes. */
    double low[3], high[3];
    /** 27 floats: the light of positions without a probe. */
    float ambient[27];
    /** What TETRALIGHT_ARRAY_HALVES are multiplied by; 0 if they are not there. */
    float half_scale;
    /** 1 if the volume knows which walls hide its probes, else 0. */
    uint32_t knows_walls;
    /** 1 if `tetralight_relight_sky`, `tetralight_relight_sun` can change it, else 0. */
    uint32_t can_relight_sky, can_relight_sun;
    /** Lights of the scene, for `tetralight_get_scene_light`. */
    uint32_t light_count;
} tetralight_details;

/** Cost: one pass over the positions. */
TETRALIGHT_API tetralight_status
tetralight_get_details(const tetralight_volume* volume, tetralight_details* details,
                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The types of lights (probes/light.h). */
typedef enum tetralight_light_type {
    TETRALIGHT_LIGHT_DIRECTIONAL = 0,
    TETRALIGHT_LIGHT_POINT = 1,
    TETRALIGHT_LIGHT_SPOT = 2,
    TETRALIGHT_LIGHT_RECTANGLE = 3,
    TETRALIGHT_LIGHT_DISC = 4
} tetralight_light_type;

/** Which part of a light the probes hold. The caller adds the rest. */
typedef enum tetralight_light_mode {
    /** Its bounces. */
    TETRALIGHT_LIGHT_MIXED = 0,
    /** All of it. */
    TETRALIGHT_LIGHT_BAKED = 1,
    /** Nothing. */
    TETRALIGHT_LIGHT_REALTIME = 2
} tetralight_light_mode;

/** How light falls off with distance (probes/light.h). */
typedef enum tetralight_light_falloff {
    TETRALIGHT_FALLOFF_GLTF = 0,
    TETRALIGHT_FALLOFF_INVERSE_SQUARE_RANGE = 1,
    TETRALIGHT_FALLOFF_LINEAR = 2,
    TETRALIGHT_FALLOFF_LEGACY = 3
} tetralight_light_falloff;

/** A light of the scene, in the units of glTF; world space. */
typedef struct tetralight_scene_light {
    /** Ends with '\0'; a longer name is truncated. */
    char name[128];
    /** A tetralight_light_type, _light_mode and _light_falloff. */
    uint32_t type, mode, falloff;
    /** Its channel of the probes' occlusion, 0 to 3, or TETRALIGHT_NO_CELL. */
    uint32_t channel;
    /** The weight of its layer; 1 = as baked. */
    float weight;
    /** Linear RGB times intensity: lux for directional lights, candela for the others. */
    float intensity[3];
    float position[3];
    /** The unit vector along which it shines. */
    float direction[3];
    /** Metres; 0 = without end. */
    float range;
    /** Cosines of the half angles of a spot light's cone. */
    float cos_inner_cone, cos_outer_cone;
    /** Metres; of directional lights half the angle in the sky, radians. */
    float radius;
    /** Of rectangles: the unit vector along the width, and metres. */
    float tangent[3];
    float width, height;
} tetralight_scene_light;

/** Returns TETRALIGHT_NOT_THERE if there is no such light. */
TETRALIGHT_API tetralight_status tetralight_get_scene_light(
    const tetralight_volume* volume, uint32_t index, tetralight_scene_light* light,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Replaces the light of the volume by the sum of its layers times these weights: one a layer, >=
 * 0. Must not run at the same time as another call on this volume. Cost: one pass over all layers.
 * Memory: that of the probes' light. Existing shader volumes and proxy volumes keep their light. */
TETRALIGHT_API tetralight_status tetralight_recombine(tetralight_volume* volume,
                                                      const float* weights, size_t weight_count,
                                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Replaces the sky: layer "sky" becomes the light that the probes transfer from it, and the light
 * of the volume its sum with the other layers at their weights. `sky`: 48 floats, its radiance as
 * 16 RGB coefficients of bands 0 to 3, L_i = integral of L Y_i (probes/distant_light.h);
 * TETRALIGHT_ARRAY_SKY is the present one. Adds the name of this function to member "relit" of
 * the metadata: `tetralight verify` and bakes that reuse probes then know that the light is not
 * that of the scene. Returns TETRALIGHT_NOT_THERE if the volume holds no transfer or no layer
 * "sky". Memory and cost: a copy of the volume. */
TETRALIGHT_API tetralight_status tetralight_relight_sky(
    tetralight_volume* volume, const float* sky, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Moves the sun: layer "sun" becomes the light that the probes transfer from a sun that shines
 * along the unit vector `direction` (three floats), with `irradiance` (three floats, >= 0) on a
 * surface that faces it. Of a mixed sun only the bounces: the caller adds the direct light. Its
 * occlusion is that of the old direction, and it loses its channel. Adds the name of this function
 * to the metadata, as `tetralight_relight_sky` does. Returns TETRALIGHT_NOT_THERE if the volume
 * holds no transfer, or not exactly one sun in layer "sun". Memory and cost: a copy of the volume.
 */
TETRALIGHT_API tetralight_status
tetralight_relight_sun(tetralight_volume* volume, const float* direction, const float* irradiance,
                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Writes the volume with its present light to a file, which replaces an older one only as a
 * whole; path "-" is stdout. Sections of the opened file that are not of the volume are left out.
 * Memory: 1 MiB, to read the file back and compare it. Returns TETRALIGHT_UNSUPPORTED for joined
 * volumes: save each of them instead. Windows does not replace a file while it is open, here or in
 * another program: the call returns TETRALIGHT_UNAVAILABLE for the path that the volume was opened
 * from. */
TETRALIGHT_API tetralight_status tetralight_save(const tetralight_volume* volume, const char* path,
                                                 tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The light at one position (three floats), of the probes that no wall hides; a batch of one has
 * more options. `hint`, which may be NULL, gives the cell where the search starts and receives the
 * cell found. A position that is not finite receives the ambient light and no cell. */
TETRALIGHT_API tetralight_status tetralight_query(const tetralight_volume* volume,
                                                  const float* position, uint32_t* hint,
                                                  tetralight_light* light,
                                                  tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The light at many positions. `report` may be NULL. */
TETRALIGHT_API tetralight_status
tetralight_query_batch(const tetralight_volume* volume, const tetralight_batch* batch,
                       tetralight_report* report, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The light of instances. `report` may be NULL. */
TETRALIGHT_API tetralight_status
tetralight_pack_instances(const tetralight_volume* volume, const tetralight_instances* instances,
                          tetralight_report* report, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Volumes that join and leave while a game runs, and that together light what is between them:
 * streamed cells of a level, prefabs.
 *
 *     tetralight_joined_create(&joined, &error);
 *     const tetralight_volume* volume = tetralight_joined_volume(joined);   // for queries
 *     tetralight_joined_add(joined, "hall", hall, &error);
 *     while (in_each_frame) {
 *         uint32_t is_ready = 0;
 *         tetralight_joined_step(joined, 500, &is_ready, &error);
 *         if (is_ready) tetralight_joined_commit(joined, &error);
 *     }
 *
 * Each call must run alone on its `joined`, but queries of its volume may run beside add, remove
 * and step. */
typedef struct tetralight_joined tetralight_joined;

/** No volumes. Destroy `*joined` after use. */
TETRALIGHT_API tetralight_status
tetralight_joined_create(tetralight_joined** joined, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Destroys `joined` and its volume; does nothing if it is NULL. */
TETRALIGHT_API void tetralight_joined_destroy(tetralight_joined* joined) TETRALIGHT_NOEXCEPT;

/** Orders that a volume joins, under a name that no other has. It must not be closed,
 * recombined or relit until it has left and `tetralight_joined_commit` was called. */
TETRALIGHT_API tetralight_status tetralight_joined_add(tetralight_joined* joined, const char* name,
                                                       const tetralight_volume* part,
                                                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Orders that a volume leaves. */
TETRALIGHT_API tetralight_status tetralight_joined_remove(
    tetralight_joined* joined, const char* name, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Works on what was ordered for about this long. `*is_ready` becomes 1 once all of it is done, and
 * 0 before. All is made anew in one call for the first volumes, for probes in a plane, nearer to
 * each other than a millimetre, or far outside of those before. If memory is short, the call
 * returns TETRALIGHT_OUT_OF_RESOURCES, queries go on as before, and the next call begins anew. */
TETRALIGHT_API tetralight_status
tetralight_joined_step(tetralight_joined* joined, uint32_t budget_microseconds, uint32_t* is_ready,
                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Queries read what is ready from now on. No query may run meanwhile. Without effect if nothing is
 * ready. Hints from before stay useful. */
TETRALIGHT_API tetralight_status
tetralight_joined_commit(tetralight_joined* joined, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The volume that queries read: the same pointer until `joined` is destroyed. It has no layers:
 * its light is that of the volumes as they joined. NULL if `joined` is NULL. */
TETRALIGHT_API const tetralight_volume* tetralight_joined_volume(const tetralight_joined* joined)
    TETRALIGHT_NOEXCEPT;

/** Packs 27 coefficients of irradiance, all finite, as the 28 floats of TETRALIGHT_SH_PACKED.
 * Thread-safe. */
TETRALIGHT_API tetralight_status tetralight_pack_sh(const float* coefficients, float* packed,
                                                    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Irradiance / pi (three floats) at a unit normal from 28 packed floats, all finite. Times albedo
 * it is the diffuse exitant radiance. Thread-safe. */
TETRALIGHT_API tetralight_status tetralight_sample_sh9(const float* packed, const float* normal,
                                                       float* rgb,
                                                       tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Which bands of the light vary within a proxy volume (lppv/lppv.h). */
typedef enum tetralight_lppv_quality {
    TETRALIGHT_LPPV_LOW = 0,
    TETRALIGHT_LPPV_NORMAL = 1,
    TETRALIGHT_LPPV_FULL = 2
} tetralight_lppv_quality;

/** The positions of the grid points in the box. */
typedef enum tetralight_lppv_placement {
    TETRALIGHT_LPPV_CELL_CORNERS = 0,
    TETRALIGHT_LPPV_CELL_CENTERS = 1
} tetralight_lppv_placement;

/** The slabs of the texture along X (lppv/lppv_texture.h). */
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

/** A proxy volume: a grid of light around a large object. Its constants must be finite floats. */
typedef struct tetralight_lppv_box {
    /** The transform of the object, by columns. */
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

/** The uniforms of the texture: TetralightLppvConstants of runtime/shaders/lppv.glsl. */
typedef struct tetralight_lppv_constants {
    float local_from_world[16];
    float params[4], low[4], size_inverse[4];
    float shb_r[4], shb_g[4], shb_b[4], shc[4];
} tetralight_lppv_constants;

/** The size of a proxy volume's texture. Thread-safe. */
TETRALIGHT_API tetralight_status
tetralight_get_lppv_size(const tetralight_lppv_box* box, tetralight_lppv_size* size,
                         tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Fills a texture, x fastest, and its constants. Cost: one query per grid point. Allocates. */
TETRALIGHT_API tetralight_status tetralight_fill_lppv(const tetralight_volume* volume,
                                                      const tetralight_lppv_box* box,
                                                      const tetralight_array* texels,
                                                      tetralight_lppv_constants* constants,
                                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** A volume for queries by shaders (runtime/shader_volume.h): arrays that are ready to upload. */
typedef struct tetralight_shader_volume tetralight_shader_volume;

/** The uniform block, then in the order of their bindings: positions, light, cells, hull rays,
 * seeds, walls. */
#define TETRALIGHT_SHADER_ARRAY_COUNT 7

/** Makes the arrays. Free `*made` after use. It does not refer to the volume. */
TETRALIGHT_API tetralight_status
tetralight_make_shader_volume(const tetralight_volume* volume, tetralight_shader_volume** made,
                              tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** One of the arrays, valid until `made` is freed. No array is empty. Thread-safe. */
TETRALIGHT_API tetralight_status tetralight_get_shader_array(
    const tetralight_shader_volume* made, uint32_t index, tetralight_const_array* array,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Frees the arrays; does nothing if `made` is NULL. */
TETRALIGHT_API void tetralight_free_shader_volume(tetralight_shader_volume* made)
    TETRALIGHT_NOEXCEPT;

/** Open lightmaps (lightmap/lightmaps.h). */
typedef struct tetralight_lightmaps tetralight_lightmaps;

/** The page of an instance without a lightmap, which takes its light from probes. */
#define TETRALIGHT_NO_PAGE 0xffffffffu

/** The contents of lightmaps. */
typedef struct tetralight_lightmaps_info {
    /** Texels along each side of every page. */
    uint32_t page_size;
    uint32_t page_count;
    /** Instances of the scene, with or without a lightmap. */
    uint32_t instance_count;
    /** 1 if normal maps have an effect, else 0. */
    uint32_t has_light;
    /** What halves of textures are multiplied by. */
    float scale;
    /** How mixed lights are in the texels: 0 = bounces, with real-time shadows; 1 = bounces, with a
     * shadow mask; 2 = bounces and direct light. */
    uint32_t mixed_lighting;
    /** 1 if there is ambient occlusion, else 0. */
    uint32_t has_ambient_occlusion;
} tetralight_lightmaps_info;

/** The place of an instance: uv_page = uv * scale + offset, with the unwrapped uv (TEXCOORD_1) of
 * its mesh. */
typedef struct tetralight_lightmap_place {
    float scale[2], offset[2];
    /** Or TETRALIGHT_NO_PAGE; scale and offset are 0 then. */
    uint32_t page;
} tetralight_lightmap_place;

/** Opens a file and verifies all of it. Close `*lightmaps` after use. All other calls may run on
 * one `lightmaps` at the same time, but for close. */
TETRALIGHT_API tetralight_status
tetralight_lightmaps_open(const char* path, tetralight_lightmaps** lightmaps,
                          tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The same for a file that is in memory. Copies the bytes. */
TETRALIGHT_API tetralight_status
tetralight_lightmaps_open_memory(const void* bytes, size_t size, tetralight_lightmaps** lightmaps,
                                 tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Closes lightmaps; does nothing if they are NULL. */
TETRALIGHT_API void tetralight_lightmaps_close(tetralight_lightmaps* lightmaps) TETRALIGHT_NOEXCEPT;

TETRALIGHT_API tetralight_status tetralight_lightmaps_get_info(
    const tetralight_lightmaps* lightmaps, tetralight_lightmaps_info* info,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The place of an instance, by its index in the scene. Returns TETRALIGHT_NOT_THERE if there is no
 * such instance. */
TETRALIGHT_API tetralight_status tetralight_lightmaps_rectangle(
    const tetralight_lightmaps* lightmaps, uint32_t instance, tetralight_lightmap_place* place,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The arrays of lightmaps. Texels are ordered by page, row and column; row 0 is at v = 0. */
typedef enum tetralight_lightmap_array {
    /** Four halves a texel: irradiance divided by `tetralight_lightmaps_info.scale`, and 1 where a
     * surface is. */
    TETRALIGHT_LIGHTMAP_IRRADIANCE = 0,
    /** 12 halves a texel: the light for normal maps (lightmap/lightmaps.h). */
    TETRALIGHT_LIGHTMAP_LIGHT = 1,
    /** One byte a texel: 255 = its rays hit no back face. */
    TETRALIGHT_LIGHTMAP_VALIDITY = 2,
    /** One half a texel: the relative standard error of its irradiance. */
    TETRALIGHT_LIGHTMAP_STANDARD_ERROR = 3,
    /** Four bytes a texel, 255 = lit. */
    TETRALIGHT_LIGHTMAP_SHADOW_MASK = 4,
    /** One byte a texel: 255 = open. */
    TETRALIGHT_LIGHTMAP_AMBIENT_OCCLUSION = 5,
    /** Text, one name a line, each ended by a line feed. */
    TETRALIGHT_LIGHTMAP_INSTANCE_NAMES = 6,
    /** Text: how the lightmaps were made, a JSON object. */
    TETRALIGHT_LIGHTMAP_METADATA = 7
} tetralight_lightmap_array;

/** An array of lightmaps without a copy, `which` a tetralight_lightmap_array; valid until close.
 * `stride` is not 0. Returns TETRALIGHT_NOT_THERE if the array is empty. */
TETRALIGHT_API tetralight_status tetralight_lightmaps_get_array(
    const tetralight_lightmaps* lightmaps, uint32_t which, tetralight_const_array* array,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Irradiance (three floats) at a place of a page (two floats), bilinear, not divided by pi. With a
 * unit `normal` (three floats, world space) it is that on this normal, as normal maps give, on a
 * surface whose own unit normal is `base_normal`. Both may be NULL: the irradiance is that on the
 * surface. Returns TETRALIGHT_NOT_THERE if there is no such page. */
TETRALIGHT_API tetralight_status
tetralight_lightmaps_sample(const tetralight_lightmaps* lightmaps, uint32_t page,
                            const float* uv_page, const float* base_normal, const float* normal,
                            float* irradiance, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** How much of the light of each of the four occlusion channels the texels see at a place of a
 * page, 0 to 1 (four floats): the shadows of static objects. 1 without a shadow mask. Returns
 * TETRALIGHT_NOT_THERE if there is no such page. */
TETRALIGHT_API tetralight_status tetralight_lightmaps_shadow_mask(
    const tetralight_lightmaps* lightmaps, uint32_t page, const float* uv_page, float* visible,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** How open the surroundings are at a place of a page, 0 to 1 (one float), which the irradiance
 * does not include. 1 if it was not baked. Returns TETRALIGHT_NOT_THERE if there is no such page.
 */
TETRALIGHT_API tetralight_status tetralight_lightmaps_ambient_occlusion(
    const tetralight_lightmaps* lightmaps, uint32_t page, const float* uv_page, float* open,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Open reflection probes (reflection/reflections.h). */
typedef struct tetralight_reflections tetralight_reflections;

/** The contents of reflection probes. */
typedef struct tetralight_reflections_info {
    /** Texels along each side of a face of level 0; half as many in each further level. */
    uint32_t size;
    /** Level i is blurred for the roughness 1 - sqrt(1 - i / (level_count - 1)). */
    uint32_t level_count;
    /** Also the number of cubes. */
    uint32_t probe_count;
} tetralight_reflections_info;

/** Where a cube was captured, and where it is used. */
typedef struct tetralight_reflection_probe {
    double position[3];
    /** The center of the box relative to the position, metres. */
    float box_center[3];
    /** Half of the box along its axes, metres. Infinite: the probe is used everywhere. */
    float half_size[3];
    /** Unit vectors in world axes, one after the other. */
    float axes[9];
    /** Outside the box the probe fades out over this distance, metres. */
    float blend_distance;
    /** Probes of higher importance hide those of lower importance. */
    int32_t importance;
    /** Fraction of the rays of the cube that hit no back face. */
    float validity;
} tetralight_reflection_probe;

/** The probes that light a position, and their weights, which sum to 1. */
typedef struct tetralight_reflection_blend {
    uint32_t probes[3];
    float weights[3];
} tetralight_reflection_blend;

/** Opens a file and verifies all of it. Close `*reflections` after use. All other calls may run on
 * one `reflections` at the same time, but for close. */
TETRALIGHT_API tetralight_status
tetralight_reflections_open(const char* path, tetralight_reflections** reflections,
                            tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The same for a file that is in memory. Copies the bytes. */
TETRALIGHT_API tetralight_status tetralight_reflections_open_memory(
    const void* bytes, size_t size, tetralight_reflections** reflections,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Closes reflection probes; does nothing if they are NULL. */
TETRALIGHT_API void tetralight_reflections_close(tetralight_reflections* reflections)
    TETRALIGHT_NOEXCEPT;

TETRALIGHT_API tetralight_status tetralight_reflections_get_info(
    const tetralight_reflections* reflections, tetralight_reflections_info* info,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Returns TETRALIGHT_NOT_THERE if there is no such probe. */
TETRALIGHT_API tetralight_status tetralight_reflections_get_probe(
    const tetralight_reflections* reflections, uint32_t index, tetralight_reflection_probe* probe,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The texels of a level as an array of cubes is uploaded: four halves each, probe after probe,
 * face after face (+X, -X, +Y, -Y, +Z, -Z), row after row. Valid until close. Returns
 * TETRALIGHT_NOT_THERE if there is no such level. */
TETRALIGHT_API tetralight_status tetralight_reflections_texels(
    const tetralight_reflections* reflections, uint32_t level, tetralight_const_array* texels,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The three most important probes at a position (three doubles). */
TETRALIGHT_API tetralight_status tetralight_reflections_blend(
    const tetralight_reflections* reflections, const double* position,
    tetralight_reflection_blend* blend, tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** The radiance (three floats) that a surface of a roughness sees at a position (three doubles) in
 * a direction (three floats): the view mirrored at its normal. */
TETRALIGHT_API tetralight_status tetralight_reflections_sample(
    const tetralight_reflections* reflections, const tetralight_reflection_blend* blend,
    const double* position, const float* direction, float roughness, float* radiance,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** What reflections are multiplied with, so that dark corners do not shine, 0 to 1 (one float): the
 * luminance of `irradiance` (three floats, not divided by pi), that of light probes or a lightmap
 * on a unit normal, over that of the cubes on the same normal. 1 for mirrors, below roughness
 * 0.1; this ratio above 0.5. */
TETRALIGHT_API tetralight_status tetralight_reflections_occlusion(
    const tetralight_reflections* reflections, const tetralight_reflection_blend* blend,
    const float* normal, const float* irradiance, float roughness, float* occlusion,
    tetralight_error* error) TETRALIGHT_NOEXCEPT;

/** Scale and bias of F0 (two floats) in the reflectance of a surface, for a table over n . v and
 * roughness, both 0 to 1. `sample_count` > 0; 256 is a good one. */
TETRALIGHT_API tetralight_status tetralight_split_sum(float n_dot_v, float roughness,
                                                      uint32_t sample_count, float* scale_and_bias,
                                                      tetralight_error* error) TETRALIGHT_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif
