// SPDX-License-Identifier: Apache-2.0
// Written by packages/bindings/generate.py from runtime/tetralight.h: change that header.
// The runtime for C, and for every language that can call C.
//
//     tetralight_error error;
//     tetralight_volume* volume = NULL;
//     if (tetralight_open("level.probes", &volume, &error) != TETRALIGHT_OK) {
//         fprintf(stderr, "%s\n", error.message);
//     }
//     tetralight_light light;
//     tetralight_query(volume, position, NULL, &light, &error);
//     tetralight_close(volume);
//
// Errors: every call returns a status. `error` receives a message, empty with TETRALIGHT_OK; it may
// be NULL. A call that fails leaves its outputs unchanged. NULL, misaligned pointers, wrong strides
// and short buffers are reported as statuses. The caller guarantees that every other pointer leads
// to memory of the size that it states. No exception leaves a call.
//
// Memory: queries and packing do not allocate. The calls that need much memory (open_memory,
// recombine, relight, save, fill_lppv, make_shader_volume) first ask for all of it, and return
// TETRALIGHT_OUT_OF_MEMORY if the system refuses. The program still ends in three cases: if a
// message or another small piece (below 64 KiB a call) cannot be allocated, if the system promises
// more memory than it has, and if another thread takes the memory in between
// (docs/decisions/0037-memory-through-the-c-api.md).
//
// Threads: calls on different volumes are independent. Calls that take a `const` volume may run on
// one volume at the same time. The others (recombine, relight, close) must run alone on their
// volume.
//
// Space is right-handed, Y up, in metres; light is linear Rec.709 (docs/conventions.md).
// Compile it with /unsafe, and with TETRALIGHT_WINDOWS, TETRALIGHT_MACOS or TETRALIGHT_STATIC where the
// library is not libtetralight.so.0. Texts are UTF-8 and end with a zero byte.
using System;
using System.Runtime.InteropServices;

namespace Tetralight
{
    public enum tetralight_status : uint
    {
        TETRALIGHT_OK = 0,
        /// <summary>A required pointer is NULL, or a pointer is not aligned to its type.</summary>
        TETRALIGHT_BAD_POINTER = 1,
        /// <summary>A stride, an enumerator or a number is out of range, or a number is not finite.</summary>
        TETRALIGHT_BAD_VALUE = 2,
        /// <summary>A buffer is too short for its count.</summary>
        TETRALIGHT_SHORT_BUFFER = 3,
        /// <summary>There is no such file, or the path does not lead to a regular file.</summary>
        TETRALIGHT_BAD_FILE = 4,
        /// <summary>The volume, the lightmaps or the reflection probes do not contain the requested item.</summary>
        TETRALIGHT_NOT_THERE = 5,
        /// <summary>The system refuses the number of bytes that the message gives.</summary>
        TETRALIGHT_OUT_OF_MEMORY = 6,
        /// <summary>The bytes of the file are wrong: opening it again fails again.</summary>
        TETRALIGHT_CORRUPT = 7,
        /// <summary>This version of the library cannot read a file that is valid, or save joined volumes.</summary>
        TETRALIGHT_UNSUPPORTED = 8,
        /// <summary>The file cannot be read now (I/O error, permissions, network): try again later.</summary>
        TETRALIGHT_UNAVAILABLE = 9,
        /// <summary>Memory or file descriptors are used up: try again later.</summary>
        TETRALIGHT_OUT_OF_RESOURCES = 10,
        /// <summary>There is no space left for a file that is written.</summary>
        TETRALIGHT_DISK_FULL = 11,
        /// <summary>The caller stopped the work.</summary>
        TETRALIGHT_CANCELLED = 12,
    }

    /// <summary>The light outside the hull of the probes (probes/locate.h).</summary>
    public enum tetralight_outside : uint
    {
        TETRALIGHT_EXTRAPOLATE = 0,
        TETRALIGHT_CLAMP = 1,
        /// <summary>As clamp, fading to the ambient light of the volume over `fade_distance`.</summary>
        TETRALIGHT_AMBIENT = 2,
    }

    /// <summary>Whether walls of the scene hide probes behind them (probes/edge_visibility.h). A volume that
    /// knows no walls gives the same light with both.</summary>
    public enum tetralight_walls : uint
    {
        TETRALIGHT_HIDE_PROBES = 0,
        TETRALIGHT_IGNORE_WALLS = 1,
    }

    /// <summary>The format of irradiance in an array.</summary>
    public enum tetralight_sh_format : uint
    {
        /// <summary>27 floats: nine RGB coefficients, E(n) = sum of E_i Y_i(n).</summary>
        TETRALIGHT_SH_COEFFICIENTS = 0,
        /// <summary>28 floats: seven float4 for shaders, which evaluate E(n) / pi from them.</summary>
        TETRALIGHT_SH_PACKED = 1,
        /// <summary>27 half floats: the same coefficients.</summary>
        TETRALIGHT_SH_HALF = 2,
    }

    /// <summary>The arrays of a volume.</summary>
    public enum tetralight_volume_array : uint
    {
        /// <summary>Three floats a probe, relative to `tetralight_details.world_origin`.</summary>
        TETRALIGHT_ARRAY_POSITIONS = 0,
        /// <summary>Three doubles a probe: the world positions that were tetrahedralized.</summary>
        TETRALIGHT_ARRAY_EXACT_POSITIONS = 1,
        /// <summary>27 floats a probe: TETRALIGHT_SH_COEFFICIENTS.</summary>
        TETRALIGHT_ARRAY_IRRADIANCE = 2,
        /// <summary>32 halves a probe: 27 coefficients divided by `tetralight_details.half_scale`, four of
        /// occlusion, validity. Queries read these if they are there.</summary>
        TETRALIGHT_ARRAY_HALVES = 3,
        /// <summary>Four floats a probe, 1 = lit.</summary>
        TETRALIGHT_ARRAY_OCCLUSION = 4,
        /// <summary>One float a probe: the fraction of its rays that hit no back face.</summary>
        TETRALIGHT_ARRAY_VALIDITY = 5,
        /// <summary>One float a probe: the relative standard error of its irradiance; 0 = not known.</summary>
        TETRALIGHT_ARRAY_STANDARD_ERROR = 6,
        /// <summary>One float a probe: metres to the nearest surface; can be infinite.</summary>
        TETRALIGHT_ARRAY_SURFACE_DISTANCE = 7,
        /// <summary>Three floats a probe, metres: from the probe to where its rays start.</summary>
        TETRALIGHT_ARRAY_VIRTUAL_OFFSET = 8,
        /// <summary>One uint32_t a probe. Not 0: its light is that of the valid probes around it.</summary>
        TETRALIGHT_ARRAY_DILATED = 9,
        /// <summary>One uint32_t a probe, bit i: it lights objects on rendering layer i.</summary>
        TETRALIGHT_ARRAY_RENDERING_LAYERS = 10,
        /// <summary>Four uint32_t a cell: its probes, TETRALIGHT_NO_CELL in unused places.</summary>
        TETRALIGHT_ARRAY_CELL_VERTICES = 11,
        /// <summary>Four uint32_t a cell: the cell opposite each of its vertices.</summary>
        TETRALIGHT_ARRAY_CELL_NEIGHBORS = 12,
        /// <summary>Nine floats a cell outside the hull: the unit rays along which its vertices extend.</summary>
        TETRALIGHT_ARRAY_HULL_RAYS = 13,
        /// <summary>Three uint32_t a source: group, index in the group, probe or TETRALIGHT_NO_CELL.</summary>
        TETRALIGHT_ARRAY_SOURCES = 14,
        /// <summary>27 floats a probe, layer after layer, at weight 1.</summary>
        TETRALIGHT_ARRAY_LAYER_IRRADIANCE = 15,
        /// <summary>One float a probe, layer after layer: the relative standard error; 0 = not known.</summary>
        TETRALIGHT_ARRAY_LAYER_ERRORS = 16,
        /// <summary>48 floats: the sky, as `tetralight_relight_sky` takes it.</summary>
        TETRALIGHT_ARRAY_SKY = 17,
        /// <summary>Text, one name a line, each ended by a line feed.</summary>
        TETRALIGHT_ARRAY_GROUP_NAMES = 18,
        TETRALIGHT_ARRAY_LIGHT_NAMES = 19,
        TETRALIGHT_ARRAY_LAYER_NAMES = 20,
        /// <summary>Text: how the volume was made, a JSON object.</summary>
        TETRALIGHT_ARRAY_METADATA = 21,
    }

    /// <summary>The types of lights (probes/light.h).</summary>
    public enum tetralight_light_type : uint
    {
        TETRALIGHT_LIGHT_DIRECTIONAL = 0,
        TETRALIGHT_LIGHT_POINT = 1,
        TETRALIGHT_LIGHT_SPOT = 2,
        TETRALIGHT_LIGHT_RECTANGLE = 3,
        TETRALIGHT_LIGHT_DISC = 4,
    }

    /// <summary>Which part of a light the probes hold. The caller adds the rest.</summary>
    public enum tetralight_light_mode : uint
    {
        /// <summary>Its bounces.</summary>
        TETRALIGHT_LIGHT_MIXED = 0,
        /// <summary>All of it.</summary>
        TETRALIGHT_LIGHT_BAKED = 1,
        /// <summary>Nothing.</summary>
        TETRALIGHT_LIGHT_REALTIME = 2,
    }

    /// <summary>How light falls off with distance (probes/light.h).</summary>
    public enum tetralight_light_falloff : uint
    {
        TETRALIGHT_FALLOFF_GLTF = 0,
        TETRALIGHT_FALLOFF_INVERSE_SQUARE_RANGE = 1,
        TETRALIGHT_FALLOFF_LINEAR = 2,
        TETRALIGHT_FALLOFF_LEGACY = 3,
    }

    /// <summary>Which bands of the light vary within a proxy volume (lppv/lppv.h).</summary>
    public enum tetralight_lppv_quality : uint
    {
        TETRALIGHT_LPPV_LOW = 0,
        TETRALIGHT_LPPV_NORMAL = 1,
        TETRALIGHT_LPPV_FULL = 2,
    }

    /// <summary>The positions of the grid points in the box.</summary>
    public enum tetralight_lppv_placement : uint
    {
        TETRALIGHT_LPPV_CELL_CORNERS = 0,
        TETRALIGHT_LPPV_CELL_CENTERS = 1,
    }

    /// <summary>The slabs of the texture along X (lppv/lppv_texture.h).</summary>
    public enum tetralight_lppv_layout : uint
    {
        /// <summary>SHAr | SHAg | SHAb | occlusion; band 2 is the same for the whole object.</summary>
        TETRALIGHT_LPPV_FOUR_SLABS = 0,
        /// <summary>SHAr | SHAg | SHAb | SHBr | SHBg | SHBb | SHC</summary>
        TETRALIGHT_LPPV_SEVEN_SLABS = 1,
    }

    /// <summary>RGBA texels of halves or floats.</summary>
    public enum tetralight_lppv_format : uint
    {
        TETRALIGHT_LPPV_HALF = 0,
        TETRALIGHT_LPPV_FLOAT = 1,
    }

    /// <summary>The arrays of lightmaps. Texels are ordered by page, row and column; row 0 is at v = 0.</summary>
    public enum tetralight_lightmap_array : uint
    {
        /// <summary>Four halves a texel: irradiance divided by `tetralight_lightmaps_info.scale`, and 1 where a
        /// surface is.</summary>
        TETRALIGHT_LIGHTMAP_IRRADIANCE = 0,
        /// <summary>12 halves a texel: the light for normal maps (lightmap/lightmaps.h).</summary>
        TETRALIGHT_LIGHTMAP_LIGHT = 1,
        /// <summary>One byte a texel: 255 = its rays hit no back face.</summary>
        TETRALIGHT_LIGHTMAP_VALIDITY = 2,
        /// <summary>One half a texel: the relative standard error of its irradiance.</summary>
        TETRALIGHT_LIGHTMAP_STANDARD_ERROR = 3,
        /// <summary>Four bytes a texel, 255 = lit.</summary>
        TETRALIGHT_LIGHTMAP_SHADOW_MASK = 4,
        /// <summary>One byte a texel: 255 = open.</summary>
        TETRALIGHT_LIGHTMAP_AMBIENT_OCCLUSION = 5,
        /// <summary>Text, one name a line, each ended by a line feed.</summary>
        TETRALIGHT_LIGHTMAP_INSTANCE_NAMES = 6,
        /// <summary>Text: how the lightmaps were made, a JSON object.</summary>
        TETRALIGHT_LIGHTMAP_METADATA = 7,
    }

    /// <summary>One line that says what is wrong and where, ends with '\0'; a longer message is truncated.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_error
    {
        public fixed byte message[512];
    }

    /// <summary>An open probe volume.</summary>
    public struct tetralight_volume
    {
    }

    /// <summary>The contents of a volume.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_info
    {
        public uint probe_count;
        public uint cell_count;
        /// <summary>Cells with this index or a higher one lie outside the hull of the probes.</summary>
        public uint inner_cell_count;
        /// <summary>0 none, 1 one probe, 2 probes on a line, 3 in a plane, 4 in space.</summary>
        public uint dimension;
        /// <summary>1 if the volume has baked light and occlusion, else 0.</summary>
        public uint has_light;
        /// <summary>1 if the volume has baked light and occlusion, else 0.</summary>
        public uint has_occlusion;
        /// <summary>Number of layers, and of weights that `tetralight_recombine` takes.</summary>
        public uint layer_count;
    }

    /// <summary>A layer of light: the sun, the sky, a light of the scene.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_layer
    {
        /// <summary>For example "light:lamp", ends with '\0'; a longer name is truncated.</summary>
        public fixed byte name[128];
        /// <summary>Its weight in the volume's light; 1 = as baked.</summary>
        public float weight;
    }

    /// <summary>The light at one position.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_light
    {
        /// <summary>As TETRALIGHT_SH_PACKED: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC.</summary>
        public fixed float packed[28];
        /// <summary>Four channels, 1 = lit.</summary>
        public fixed float occlusion[4];
        /// <summary>Barycentric weights of the cell's probes, &gt;= 0; they sum to 1. Walls do not change them.</summary>
        public fixed float weights[4];
        /// <summary>The cell that contains the position, or TETRALIGHT_NO_CELL if the light is ambient.</summary>
        public uint cell;
    }

    /// <summary>An array of the caller. Element i begins at byte i * stride.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_array
    {
        public void* data;
        /// <summary>Bytes from `data` to the end of the buffer.</summary>
        public UIntPtr size;
        /// <summary>Bytes from one element to the next; 0 = elements without gaps.</summary>
        public UIntPtr stride;
    }

    /// <summary>The same for an array that is only read.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_const_array
    {
        public void* data;
        public UIntPtr size;
        public UIntPtr stride;
    }

    /// <summary>Many positions in one call. An array whose `data` is NULL is not written.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_batch
    {
        public UIntPtr count;
        /// <summary>Three floats each, world space.</summary>
        public tetralight_const_array positions;
        /// <summary>uint32_t each, without gaps. In: the cells where searches start. Out: the cells found. May
        /// be NULL.</summary>
        public tetralight_array hints;
        public tetralight_array sh;
        /// <summary>A tetralight_sh_format.</summary>
        public uint sh_format;
        /// <summary>Four floats each. Either `sh` or `occlusion` may be NULL.</summary>
        public tetralight_array occlusion;
        /// <summary>A tetralight_outside.</summary>
        public uint outside;
        /// <summary>Metres, &gt; 0; read only if `outside` is TETRALIGHT_AMBIENT.</summary>
        public float fade_distance;
        /// <summary>A tetralight_walls.</summary>
        public uint walls;
        /// <summary>uint32_t each, without gaps; bit i: what is lit is on rendering layer i, and probes on none
        /// of its layers do not light it. NULL or 0 = all layers.</summary>
        public tetralight_const_array rendering_layers;
        /// <summary>float each, without gaps, metres, &gt;= 0: light of probes behind a wall fades over this
        /// distance. NULL = 0.</summary>
        public tetralight_const_array radii;
        /// <summary>Three floats each, without gaps: unit normals of surfaces that the positions lie on, along
        /// which they are pushed off. Such a batch takes about twice the time. May be NULL.</summary>
        public tetralight_const_array normals;
        /// <summary>The share of the mean distance to the probes that positions with normals are pushed by, &gt;=
        /// 0; TETRALIGHT_NORMAL_OFFSET is a good one.</summary>
        public float normal_offset;
    }

    /// <summary>Counts of a batch.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_report
    {
        /// <summary>Positions that are not finite; they receive the ambient light.</summary>
        public ulong not_finite_count;
        /// <summary>Cells that the searches tested.</summary>
        public ulong step_count;
    }

    /// <summary>Instances as renderers upload them: one array for each of the seven float4.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_instances
    {
        public UIntPtr count;
        public tetralight_const_array positions;
        public tetralight_array hints;
        /// <summary>SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC: float4 each, without gaps.</summary>
        public tetralight_array sh0, sh1, sh2, sh3, sh4, sh5, sh6;
        /// <summary>float4 each; may be NULL.</summary>
        public tetralight_array occlusion;
        /// <summary>As in tetralight_batch.</summary>
        public uint walls;
        public tetralight_const_array rendering_layers;
        public tetralight_const_array radii;
    }

    /// <summary>More about a volume.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_details
    {
        /// <summary>The world position that TETRALIGHT_ARRAY_POSITIONS are relative to.</summary>
        public fixed double world_origin[3];
        /// <summary>The box of the probes, world space; all 0 without probes.</summary>
        public fixed double low[3];
        /// <summary>The box of the probes, world space; all 0 without probes.</summary>
        public fixed double high[3];
        /// <summary>27 floats: the light of positions without a probe.</summary>
        public fixed float ambient[27];
        /// <summary>What TETRALIGHT_ARRAY_HALVES are multiplied by; 0 if they are not there.</summary>
        public float half_scale;
        /// <summary>1 if the volume knows which walls hide its probes, else 0.</summary>
        public uint knows_walls;
        /// <summary>1 if `tetralight_relight_sky`, `tetralight_relight_sun` can change it, else 0.</summary>
        public uint can_relight_sky;
        /// <summary>1 if `tetralight_relight_sky`, `tetralight_relight_sun` can change it, else 0.</summary>
        public uint can_relight_sun;
        /// <summary>Lights of the scene, for `tetralight_get_scene_light`.</summary>
        public uint light_count;
    }

    /// <summary>A light of the scene, in the units of glTF; world space.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_scene_light
    {
        /// <summary>Ends with '\0'; a longer name is truncated.</summary>
        public fixed byte name[128];
        /// <summary>A tetralight_light_type, _light_mode and _light_falloff.</summary>
        public uint type;
        /// <summary>A tetralight_light_type, _light_mode and _light_falloff.</summary>
        public uint mode;
        /// <summary>A tetralight_light_type, _light_mode and _light_falloff.</summary>
        public uint falloff;
        /// <summary>Its channel of the probes' occlusion, 0 to 3, or TETRALIGHT_NO_CELL.</summary>
        public uint channel;
        /// <summary>The weight of its layer; 1 = as baked.</summary>
        public float weight;
        /// <summary>Linear RGB times intensity: lux for directional lights, candela for the others.</summary>
        public fixed float intensity[3];
        public fixed float position[3];
        /// <summary>The unit vector along which it shines.</summary>
        public fixed float direction[3];
        /// <summary>Metres; 0 = without end.</summary>
        public float range;
        /// <summary>Cosines of the half angles of a spot light's cone.</summary>
        public float cos_inner_cone;
        /// <summary>Cosines of the half angles of a spot light's cone.</summary>
        public float cos_outer_cone;
        /// <summary>Metres; of directional lights half the angle in the sky, radians.</summary>
        public float radius;
        /// <summary>Of rectangles: the unit vector along the width, and metres.</summary>
        public fixed float tangent[3];
        public float width;
        public float height;
    }

    /// <summary>Volumes that join and leave while a game runs, and that together light what is between them:
    /// streamed cells of a level, prefabs.
    ///
    ///     tetralight_joined_create(&amp;joined, &amp;error);
    ///     const tetralight_volume* volume = tetralight_joined_volume(joined);   // for queries
    ///     tetralight_joined_add(joined, "hall", hall, &amp;error);
    ///     while (in_each_frame) {
    ///         uint32_t is_ready = 0;
    ///         tetralight_joined_step(joined, 500, &amp;is_ready, &amp;error);
    ///         if (is_ready) tetralight_joined_commit(joined, &amp;error);
    ///     }
    ///
    /// Each call must run alone on its `joined`, but queries of its volume may run beside add, remove
    /// and step.</summary>
    public struct tetralight_joined
    {
    }

    /// <summary>A proxy volume: a grid of light around a large object. Its constants must be finite floats.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_lppv_box
    {
        /// <summary>The transform of the object, by columns.</summary>
        public fixed float world_from_box[16];
        /// <summary>The box in the object's space.</summary>
        public fixed float low[3];
        /// <summary>The box in the object's space.</summary>
        public fixed float high[3];
        /// <summary>Grid points along each axis, 1 to 256.</summary>
        public fixed uint resolution[3];
        /// <summary>A tetralight_lppv_placement, _quality, _layout and _format.</summary>
        public uint placement;
        /// <summary>A tetralight_lppv_placement, _quality, _layout and _format.</summary>
        public uint quality;
        /// <summary>A tetralight_lppv_placement, _quality, _layout and _format.</summary>
        public uint layout;
        /// <summary>A tetralight_lppv_placement, _quality, _layout and _format.</summary>
        public uint format;
    }

    /// <summary>The 3D texture of a proxy volume.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_lppv_size
    {
        public fixed uint texels[3];
        public UIntPtr bytes;
    }

    /// <summary>The uniforms of the texture: TetralightLppvConstants of runtime/shaders/lppv.glsl.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_lppv_constants
    {
        public fixed float local_from_world[16];
        public fixed float @params[4];
        public fixed float low[4];
        public fixed float size_inverse[4];
        public fixed float shb_r[4];
        public fixed float shb_g[4];
        public fixed float shb_b[4];
        public fixed float shc[4];
    }

    /// <summary>A volume for queries by shaders (runtime/shader_volume.h): arrays that are ready to upload.</summary>
    public struct tetralight_shader_volume
    {
    }

    /// <summary>Open lightmaps (lightmap/lightmaps.h).</summary>
    public struct tetralight_lightmaps
    {
    }

    /// <summary>The contents of lightmaps.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_lightmaps_info
    {
        /// <summary>Texels along each side of every page.</summary>
        public uint page_size;
        public uint page_count;
        /// <summary>Instances of the scene, with or without a lightmap.</summary>
        public uint instance_count;
        /// <summary>1 if normal maps have an effect, else 0.</summary>
        public uint has_light;
        /// <summary>What halves of textures are multiplied by.</summary>
        public float scale;
        /// <summary>How mixed lights are in the texels: 0 = bounces, with real-time shadows; 1 = bounces, with a
        /// shadow mask; 2 = bounces and direct light.</summary>
        public uint mixed_lighting;
        /// <summary>1 if there is ambient occlusion, else 0.</summary>
        public uint has_ambient_occlusion;
    }

    /// <summary>The place of an instance: uv_page = uv * scale + offset, with the unwrapped uv (TEXCOORD_1) of
    /// its mesh.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_lightmap_place
    {
        public fixed float scale[2];
        public fixed float offset[2];
        /// <summary>Or TETRALIGHT_NO_PAGE; scale and offset are 0 then.</summary>
        public uint page;
    }

    /// <summary>Open reflection probes (reflection/reflections.h).</summary>
    public struct tetralight_reflections
    {
    }

    /// <summary>The contents of reflection probes.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_reflections_info
    {
        /// <summary>Texels along each side of a face of level 0; half as many in each further level.</summary>
        public uint size;
        /// <summary>Level i is blurred for the roughness 1 - sqrt(1 - i / (level_count - 1)).</summary>
        public uint level_count;
        /// <summary>Also the number of cubes.</summary>
        public uint probe_count;
    }

    /// <summary>Where a cube was captured, and where it is used.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_reflection_probe
    {
        public fixed double position[3];
        /// <summary>The center of the box relative to the position, metres.</summary>
        public fixed float box_center[3];
        /// <summary>Half of the box along its axes, metres. Infinite: the probe is used everywhere.</summary>
        public fixed float half_size[3];
        /// <summary>Unit vectors in world axes, one after the other.</summary>
        public fixed float axes[9];
        /// <summary>Outside the box the probe fades out over this distance, metres.</summary>
        public float blend_distance;
        /// <summary>Probes of higher importance hide those of lower importance.</summary>
        public int importance;
        /// <summary>Fraction of the rays of the cube that hit no back face.</summary>
        public float validity;
    }

    /// <summary>The probes that light a position, and their weights, which sum to 1.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public unsafe struct tetralight_reflection_blend
    {
        public fixed uint probes[3];
        public fixed float weights[3];
    }

    /// <summary>The functions and constants of the C API.</summary>
    public static unsafe class Native
    {
        /// <summary>The file of the library.</summary>
#if TETRALIGHT_WINDOWS
        public const string Library = "tetralight-0";
#elif TETRALIGHT_MACOS
        public const string Library = "libtetralight.0.dylib";
#elif TETRALIGHT_STATIC
        public const string Library = "__Internal";
#else
        public const string Library = "libtetralight.so.0";
#endif

        /// <summary>No cell. As a hint: the search starts at the nearest seed.</summary>
        public const uint TETRALIGHT_NO_CELL = 0xffffffffu;

        /// <summary>A good share for `tetralight_batch.normal_offset` (probes/receiver.h).</summary>
        public const float TETRALIGHT_NORMAL_OFFSET = 0.1f;

        /// <summary>The uniform block, then in the order of their bindings: positions, light, cells, hull rays,
        /// seeds, walls.</summary>
        public const uint TETRALIGHT_SHADER_ARRAY_COUNT = 7;

        /// <summary>The page of an instance without a lightmap, which takes its light from probes.</summary>
        public const uint TETRALIGHT_NO_PAGE = 0xffffffffu;

        /// <summary>The version of the library: major * 10000 + minor * 100 + patch. Thread-safe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern uint tetralight_version();

        /// <summary>The same as text, for example "0.1.0". Thread-safe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern byte* tetralight_version_string();

        /// <summary>Opens a file and verifies all of it: for files from any source. Close `*volume` after use.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_open(byte* path, tetralight_volume** volume, tetralight_error* error);

        /// <summary>Opens a file and checks only its header and section table. A corrupt section gives wrong light
        /// or the ambient light, never a read out of range; `tetralight_verify` finds it.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_open_lazy(byte* path, tetralight_volume** volume, tetralight_error* error);

        /// <summary>Opens a file that is in memory: of an archive or an asset bundle, from a network. Copies the
        /// bytes, so that they may change or go after the call, and verifies all of them. `bytes` need not
        /// be aligned. Messages begin with "memory". Close `*volume` after use.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_open_memory(void* bytes, UIntPtr size, tetralight_volume** volume, tetralight_error* error);

        /// <summary>Verifies all of a volume that `tetralight_open_lazy` has opened; for a background thread.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_verify(tetralight_volume* volume, tetralight_error* error);

        /// <summary>Closes a volume; does nothing if it is NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void tetralight_close(tetralight_volume* volume);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_info(tetralight_volume* volume, tetralight_info* info, tetralight_error* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_layer(tetralight_volume* volume, uint index, tetralight_layer* layer, tetralight_error* error);

        /// <summary>An array of a volume without a copy, `which` a tetralight_volume_array. `stride` is not 0.
        /// Valid until a call that changes the volume (recombine, relight, close; of joined volumes commit
        /// and destroy).
        /// Returns TETRALIGHT_NOT_THERE if the array is empty: files can hold light as floats, as halves or
        /// both.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_array(tetralight_volume* volume, uint which, tetralight_const_array* array, tetralight_error* error);

        /// <summary>Cost: one pass over the positions.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_details(tetralight_volume* volume, tetralight_details* details, tetralight_error* error);

        /// <summary>Returns TETRALIGHT_NOT_THERE if there is no such light.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_scene_light(tetralight_volume* volume, uint index, tetralight_scene_light* light, tetralight_error* error);

        /// <summary>Replaces the light of the volume by the sum of its layers times these weights: one a layer, &gt;=
        /// 0. Must not run at the same time as another call on this volume. Cost: one pass over all layers.
        /// Memory: that of the probes' light. Existing shader volumes and proxy volumes keep their light.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_recombine(tetralight_volume* volume, float* weights, UIntPtr weight_count, tetralight_error* error);

        /// <summary>Replaces the sky: layer "sky" becomes the light that the probes transfer from it, and the light
        /// of the volume its sum with the other layers at their weights. `sky`: 48 floats, its radiance as
        /// 16 RGB coefficients of bands 0 to 3, L_i = integral of L Y_i (probes/distant_light.h);
        /// TETRALIGHT_ARRAY_SKY is the present one. Adds the name of this function to member "relit" of
        /// the metadata: `tetralight verify` and bakes that reuse probes then know that the light is not
        /// that of the scene. Returns TETRALIGHT_NOT_THERE if the volume holds no transfer or no layer
        /// "sky". Memory and cost: a copy of the volume.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_relight_sky(tetralight_volume* volume, float* sky, tetralight_error* error);

        /// <summary>Moves the sun: layer "sun" becomes the light that the probes transfer from a sun that shines
        /// along the unit vector `direction` (three floats), with `irradiance` (three floats, &gt;= 0) on a
        /// surface that faces it. Of a mixed sun only the bounces: the caller adds the direct light. Its
        /// occlusion is that of the old direction, and it loses its channel. Adds the name of this function
        /// to the metadata, as `tetralight_relight_sky` does. Returns TETRALIGHT_NOT_THERE if the volume
        /// holds no transfer, or not exactly one sun in layer "sun". Memory and cost: a copy of the volume.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_relight_sun(tetralight_volume* volume, float* direction, float* irradiance, tetralight_error* error);

        /// <summary>Writes the volume with its present light to a file, which replaces an older one only as a
        /// whole; path "-" is stdout. Sections of the opened file that are not of the volume are left out.
        /// Memory: 1 MiB, to read the file back and compare it. Returns TETRALIGHT_UNSUPPORTED for joined
        /// volumes: save each of them instead. Windows does not replace a file while it is open, here or in
        /// another program: the call returns TETRALIGHT_UNAVAILABLE for the path that the volume was opened
        /// from.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_save(tetralight_volume* volume, byte* path, tetralight_error* error);

        /// <summary>The light at one position (three floats), of the probes that no wall hides; a batch of one has
        /// more options. `hint`, which may be NULL, gives the cell where the search starts and receives the
        /// cell found. A position that is not finite receives the ambient light and no cell.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_query(tetralight_volume* volume, float* position, uint* hint, tetralight_light* light, tetralight_error* error);

        /// <summary>The light at many positions. `report` may be NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_query_batch(tetralight_volume* volume, tetralight_batch* batch, tetralight_report* report, tetralight_error* error);

        /// <summary>The light of instances. `report` may be NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_pack_instances(tetralight_volume* volume, tetralight_instances* instances, tetralight_report* report, tetralight_error* error);

        /// <summary>No volumes. Destroy `*joined` after use.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_joined_create(tetralight_joined** joined, tetralight_error* error);

        /// <summary>Destroys `joined` and its volume; does nothing if it is NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void tetralight_joined_destroy(tetralight_joined* joined);

        /// <summary>Orders that a volume joins, under a name that no other has. It must not be closed,
        /// recombined or relit until it has left and `tetralight_joined_commit` was called.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_joined_add(tetralight_joined* joined, byte* name, tetralight_volume* part, tetralight_error* error);

        /// <summary>Orders that a volume leaves.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_joined_remove(tetralight_joined* joined, byte* name, tetralight_error* error);

        /// <summary>Works on what was ordered for about this long. `*is_ready` becomes 1 once all of it is done, and
        /// 0 before. All is made anew in one call for the first volumes, for probes in a plane, nearer to
        /// each other than a millimetre, or far outside of those before. If memory is short, the call
        /// returns TETRALIGHT_OUT_OF_RESOURCES, queries go on as before, and the next call begins anew.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_joined_step(tetralight_joined* joined, uint budget_microseconds, uint* is_ready, tetralight_error* error);

        /// <summary>Queries read what is ready from now on. No query may run meanwhile. Without effect if nothing is
        /// ready. Hints from before stay useful.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_joined_commit(tetralight_joined* joined, tetralight_error* error);

        /// <summary>The volume that queries read: the same pointer until `joined` is destroyed. It has no layers:
        /// its light is that of the volumes as they joined. NULL if `joined` is NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_volume* tetralight_joined_volume(tetralight_joined* joined);

        /// <summary>Packs 27 coefficients of irradiance, all finite, as the 28 floats of TETRALIGHT_SH_PACKED.
        /// Thread-safe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_pack_sh(float* coefficients, float* packed, tetralight_error* error);

        /// <summary>Irradiance / pi (three floats) at a unit normal from 28 packed floats, all finite. Times albedo
        /// it is the diffuse exitant radiance. Thread-safe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_sample_sh9(float* packed, float* normal, float* rgb, tetralight_error* error);

        /// <summary>The size of a proxy volume's texture. Thread-safe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_lppv_size(tetralight_lppv_box* box, tetralight_lppv_size* size, tetralight_error* error);

        /// <summary>Fills a texture, x fastest, and its constants. Cost: one query per grid point. Allocates.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_fill_lppv(tetralight_volume* volume, tetralight_lppv_box* box, tetralight_array* texels, tetralight_lppv_constants* constants, tetralight_error* error);

        /// <summary>Makes the arrays. Free `*made` after use. It does not refer to the volume.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_make_shader_volume(tetralight_volume* volume, tetralight_shader_volume** made, tetralight_error* error);

        /// <summary>One of the arrays, valid until `made` is freed. No array is empty. Thread-safe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_get_shader_array(tetralight_shader_volume* made, uint index, tetralight_const_array* array, tetralight_error* error);

        /// <summary>Frees the arrays; does nothing if `made` is NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void tetralight_free_shader_volume(tetralight_shader_volume* made);

        /// <summary>Opens a file and verifies all of it. Close `*lightmaps` after use. All other calls may run on
        /// one `lightmaps` at the same time, but for close.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_open(byte* path, tetralight_lightmaps** lightmaps, tetralight_error* error);

        /// <summary>The same for a file that is in memory. Copies the bytes.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_open_memory(void* bytes, UIntPtr size, tetralight_lightmaps** lightmaps, tetralight_error* error);

        /// <summary>Closes lightmaps; does nothing if they are NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void tetralight_lightmaps_close(tetralight_lightmaps* lightmaps);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_get_info(tetralight_lightmaps* lightmaps, tetralight_lightmaps_info* info, tetralight_error* error);

        /// <summary>The place of an instance, by its index in the scene. Returns TETRALIGHT_NOT_THERE if there is no
        /// such instance.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_rectangle(tetralight_lightmaps* lightmaps, uint instance, tetralight_lightmap_place* place, tetralight_error* error);

        /// <summary>An array of lightmaps without a copy, `which` a tetralight_lightmap_array; valid until close.
        /// `stride` is not 0. Returns TETRALIGHT_NOT_THERE if the array is empty.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_get_array(tetralight_lightmaps* lightmaps, uint which, tetralight_const_array* array, tetralight_error* error);

        /// <summary>Irradiance (three floats) at a place of a page (two floats), bilinear, not divided by pi. With a
        /// unit `normal` (three floats, world space) it is that on this normal, as normal maps give, on a
        /// surface whose own unit normal is `base_normal`. Both may be NULL: the irradiance is that on the
        /// surface. Returns TETRALIGHT_NOT_THERE if there is no such page.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_sample(tetralight_lightmaps* lightmaps, uint page, float* uv_page, float* base_normal, float* normal, float* irradiance, tetralight_error* error);

        /// <summary>How much of the light of each of the four occlusion channels the texels see at a place of a
        /// page, 0 to 1 (four floats): the shadows of static objects. 1 without a shadow mask. Returns
        /// TETRALIGHT_NOT_THERE if there is no such page.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_shadow_mask(tetralight_lightmaps* lightmaps, uint page, float* uv_page, float* visible, tetralight_error* error);

        /// <summary>How open the surroundings are at a place of a page, 0 to 1 (one float), which the irradiance
        /// does not include. 1 if it was not baked. Returns TETRALIGHT_NOT_THERE if there is no such page.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_lightmaps_ambient_occlusion(tetralight_lightmaps* lightmaps, uint page, float* uv_page, float* open, tetralight_error* error);

        /// <summary>Opens a file and verifies all of it. Close `*reflections` after use. All other calls may run on
        /// one `reflections` at the same time, but for close.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_open(byte* path, tetralight_reflections** reflections, tetralight_error* error);

        /// <summary>The same for a file that is in memory. Copies the bytes.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_open_memory(void* bytes, UIntPtr size, tetralight_reflections** reflections, tetralight_error* error);

        /// <summary>Closes reflection probes; does nothing if they are NULL.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern void tetralight_reflections_close(tetralight_reflections* reflections);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_get_info(tetralight_reflections* reflections, tetralight_reflections_info* info, tetralight_error* error);

        /// <summary>Returns TETRALIGHT_NOT_THERE if there is no such probe.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_get_probe(tetralight_reflections* reflections, uint index, tetralight_reflection_probe* probe, tetralight_error* error);

        /// <summary>The texels of a level as an array of cubes is uploaded: four halves each, probe after probe,
        /// face after face (+X, -X, +Y, -Y, +Z, -Z), row after row. Valid until close. Returns
        /// TETRALIGHT_NOT_THERE if there is no such level.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_texels(tetralight_reflections* reflections, uint level, tetralight_const_array* texels, tetralight_error* error);

        /// <summary>The three most important probes at a position (three doubles).</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_blend(tetralight_reflections* reflections, double* position, tetralight_reflection_blend* blend, tetralight_error* error);

        /// <summary>The radiance (three floats) that a surface of a roughness sees at a position (three doubles) in
        /// a direction (three floats): the view mirrored at its normal.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_sample(tetralight_reflections* reflections, tetralight_reflection_blend* blend, double* position, float* direction, float roughness, float* radiance, tetralight_error* error);

        /// <summary>What reflections are multiplied with, so that dark corners do not shine, 0 to 1 (one float): the
        /// luminance of `irradiance` (three floats, not divided by pi), that of light probes or a lightmap
        /// on a unit normal, over that of the cubes on the same normal. 1 for mirrors, below roughness
        /// 0.1; this ratio above 0.5.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_reflections_occlusion(tetralight_reflections* reflections, tetralight_reflection_blend* blend, float* normal, float* irradiance, float roughness, float* occlusion, tetralight_error* error);

        /// <summary>Scale and bias of F0 (two floats) in the reflectance of a surface, for a table over n . v and
        /// roughness, both 0 to 1. `sample_count` &gt; 0; 256 is a good one.</summary>
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        public static extern tetralight_status tetralight_split_sum(float n_dot_v, float roughness, uint sample_count, float* scale_and_bias, tetralight_error* error);
    }
}
