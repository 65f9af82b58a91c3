// SPDX-License-Identifier: Apache-2.0
// Written by packages/bindings/generate.py from runtime/tetralight.h: change that header.
//! The runtime for C, and for every language that can call C.
//!
//! ```c
//! tetralight_error error;
//! tetralight_volume* volume = NULL;
//! if (tetralight_open("level.probes", &volume, &error) != TETRALIGHT_OK) {
//!     fprintf(stderr, "%s\n", error.message);
//! }
//! tetralight_light light;
//! tetralight_query(volume, position, NULL, &light, &error);
//! tetralight_close(volume);
//! ```
//!
//! Errors: every call returns a status. `error` receives a message, empty with TETRALIGHT_OK; it may
//! be NULL. A call that fails leaves its outputs unchanged. NULL, misaligned pointers, wrong strides
//! and short buffers are reported as statuses. The caller guarantees that every other pointer leads
//! to memory of the size that it states. No exception leaves a call.
//!
//! Memory: queries and packing do not allocate. The calls that need much memory (open_memory,
//! recombine, relight, save, fill_lppv, make_shader_volume) first ask for all of it, and return
//! TETRALIGHT_OUT_OF_MEMORY if the system refuses. The program still ends in three cases: if a
//! message or another small piece (below 64 KiB a call) cannot be allocated, if the system promises
//! more memory than it has, and if another thread takes the memory in between
//! (docs/decisions/0037-memory-through-the-c-api.md).
//!
//! Threads: calls on different volumes are independent. Calls that take a `const` volume may run on
//! one volume at the same time. The others (recombine, relight, close) must run alone on their
//! volume.
//!
//! Space is right-handed, Y up, in metres; light is linear Rec.709 (docs/conventions.md).
#![allow(non_camel_case_types)]

use std::marker::{PhantomData, PhantomPinned};
use std::os::raw::{c_char, c_void};

/// No cell. As a hint: the search starts at the nearest seed.
pub const TETRALIGHT_NO_CELL: u32 = 0xffffffff;

/// A good share for `tetralight_batch.normal_offset` (probes/receiver.h).
pub const TETRALIGHT_NORMAL_OFFSET: f32 = 0.1;

/// The uniform block, then in the order of their bindings: positions, light, cells, hull rays,
/// seeds, walls.
pub const TETRALIGHT_SHADER_ARRAY_COUNT: u32 = 7;

/// The page of an instance without a lightmap, which takes its light from probes.
pub const TETRALIGHT_NO_PAGE: u32 = 0xffffffff;

pub type tetralight_status = u32;
pub const TETRALIGHT_OK: tetralight_status = 0;
/// A required pointer is NULL, or a pointer is not aligned to its type.
pub const TETRALIGHT_BAD_POINTER: tetralight_status = 1;
/// A stride, an enumerator or a number is out of range, or a number is not finite.
pub const TETRALIGHT_BAD_VALUE: tetralight_status = 2;
/// A buffer is too short for its count.
pub const TETRALIGHT_SHORT_BUFFER: tetralight_status = 3;
/// There is no such file, or the path does not lead to a regular file.
pub const TETRALIGHT_BAD_FILE: tetralight_status = 4;
/// The volume, the lightmaps or the reflection probes do not contain the requested item.
pub const TETRALIGHT_NOT_THERE: tetralight_status = 5;
/// The system refuses the number of bytes that the message gives.
pub const TETRALIGHT_OUT_OF_MEMORY: tetralight_status = 6;
/// The bytes of the file are wrong: opening it again fails again.
pub const TETRALIGHT_CORRUPT: tetralight_status = 7;
/// This version of the library cannot read a file that is valid, or save joined volumes.
pub const TETRALIGHT_UNSUPPORTED: tetralight_status = 8;
/// The file cannot be read now (I/O error, permissions, network): try again later.
pub const TETRALIGHT_UNAVAILABLE: tetralight_status = 9;
/// Memory or file descriptors are used up: try again later.
pub const TETRALIGHT_OUT_OF_RESOURCES: tetralight_status = 10;
/// There is no space left for a file that is written.
pub const TETRALIGHT_DISK_FULL: tetralight_status = 11;
/// The caller stopped the work.
pub const TETRALIGHT_CANCELLED: tetralight_status = 12;

/// The light outside the hull of the probes (probes/locate.h).
pub type tetralight_outside = u32;
pub const TETRALIGHT_EXTRAPOLATE: tetralight_outside = 0;
pub const TETRALIGHT_CLAMP: tetralight_outside = 1;
/// As clamp, fading to the ambient light of the volume over `fade_distance`.
pub const TETRALIGHT_AMBIENT: tetralight_outside = 2;

/// Whether walls of the scene hide probes behind them (probes/edge_visibility.h). A volume that
/// knows no walls gives the same light with both.
pub type tetralight_walls = u32;
pub const TETRALIGHT_HIDE_PROBES: tetralight_walls = 0;
pub const TETRALIGHT_IGNORE_WALLS: tetralight_walls = 1;

/// The format of irradiance in an array.
pub type tetralight_sh_format = u32;
/// 27 floats: nine RGB coefficients, E(n) = sum of E_i Y_i(n).
pub const TETRALIGHT_SH_COEFFICIENTS: tetralight_sh_format = 0;
/// 28 floats: seven float4 for shaders, which evaluate E(n) / pi from them.
pub const TETRALIGHT_SH_PACKED: tetralight_sh_format = 1;
/// 27 half floats: the same coefficients.
pub const TETRALIGHT_SH_HALF: tetralight_sh_format = 2;

/// The arrays of a volume.
pub type tetralight_volume_array = u32;
/// Three floats a probe, relative to `tetralight_details.world_origin`.
pub const TETRALIGHT_ARRAY_POSITIONS: tetralight_volume_array = 0;
/// Three doubles a probe: the world positions that were tetrahedralized.
pub const TETRALIGHT_ARRAY_EXACT_POSITIONS: tetralight_volume_array = 1;
/// 27 floats a probe: TETRALIGHT_SH_COEFFICIENTS.
pub const TETRALIGHT_ARRAY_IRRADIANCE: tetralight_volume_array = 2;
/// 32 halves a probe: 27 coefficients divided by `tetralight_details.half_scale`, four of
/// occlusion, validity. Queries read these if they are there.
pub const TETRALIGHT_ARRAY_HALVES: tetralight_volume_array = 3;
/// Four floats a probe, 1 = lit.
pub const TETRALIGHT_ARRAY_OCCLUSION: tetralight_volume_array = 4;
/// One float a probe: the fraction of its rays that hit no back face.
pub const TETRALIGHT_ARRAY_VALIDITY: tetralight_volume_array = 5;
/// One float a probe: the relative standard error of its irradiance; 0 = not known.
pub const TETRALIGHT_ARRAY_STANDARD_ERROR: tetralight_volume_array = 6;
/// One float a probe: metres to the nearest surface; can be infinite.
pub const TETRALIGHT_ARRAY_SURFACE_DISTANCE: tetralight_volume_array = 7;
/// Three floats a probe, metres: from the probe to where its rays start.
pub const TETRALIGHT_ARRAY_VIRTUAL_OFFSET: tetralight_volume_array = 8;
/// One uint32_t a probe. Not 0: its light is that of the valid probes around it.
pub const TETRALIGHT_ARRAY_DILATED: tetralight_volume_array = 9;
/// One uint32_t a probe, bit i: it lights objects on rendering layer i.
pub const TETRALIGHT_ARRAY_RENDERING_LAYERS: tetralight_volume_array = 10;
/// Four uint32_t a cell: its probes, TETRALIGHT_NO_CELL in unused places.
pub const TETRALIGHT_ARRAY_CELL_VERTICES: tetralight_volume_array = 11;
/// Four uint32_t a cell: the cell opposite each of its vertices.
pub const TETRALIGHT_ARRAY_CELL_NEIGHBORS: tetralight_volume_array = 12;
/// Nine floats a cell outside the hull: the unit rays along which its vertices extend.
pub const TETRALIGHT_ARRAY_HULL_RAYS: tetralight_volume_array = 13;
/// Three uint32_t a source: group, index in the group, probe or TETRALIGHT_NO_CELL.
pub const TETRALIGHT_ARRAY_SOURCES: tetralight_volume_array = 14;
/// 27 floats a probe, layer after layer, at weight 1.
pub const TETRALIGHT_ARRAY_LAYER_IRRADIANCE: tetralight_volume_array = 15;
/// One float a probe, layer after layer: the relative standard error; 0 = not known.
pub const TETRALIGHT_ARRAY_LAYER_ERRORS: tetralight_volume_array = 16;
/// 48 floats: the sky, as `tetralight_relight_sky` takes it.
pub const TETRALIGHT_ARRAY_SKY: tetralight_volume_array = 17;
/// Text, one name a line, each ended by a line feed.
pub const TETRALIGHT_ARRAY_GROUP_NAMES: tetralight_volume_array = 18;
pub const TETRALIGHT_ARRAY_LIGHT_NAMES: tetralight_volume_array = 19;
pub const TETRALIGHT_ARRAY_LAYER_NAMES: tetralight_volume_array = 20;
/// Text: how the volume was made, a JSON object.
pub const TETRALIGHT_ARRAY_METADATA: tetralight_volume_array = 21;

/// The types of lights (probes/light.h).
pub type tetralight_light_type = u32;
pub const TETRALIGHT_LIGHT_DIRECTIONAL: tetralight_light_type = 0;
pub const TETRALIGHT_LIGHT_POINT: tetralight_light_type = 1;
pub const TETRALIGHT_LIGHT_SPOT: tetralight_light_type = 2;
pub const TETRALIGHT_LIGHT_RECTANGLE: tetralight_light_type = 3;
pub const TETRALIGHT_LIGHT_DISC: tetralight_light_type = 4;

/// Which part of a light the probes hold. The caller adds the rest.
pub type tetralight_light_mode = u32;
/// Its bounces.
pub const TETRALIGHT_LIGHT_MIXED: tetralight_light_mode = 0;
/// All of it.
pub const TETRALIGHT_LIGHT_BAKED: tetralight_light_mode = 1;
/// Nothing.
pub const TETRALIGHT_LIGHT_REALTIME: tetralight_light_mode = 2;

/// How light falls off with distance (probes/light.h).
pub type tetralight_light_falloff = u32;
pub const TETRALIGHT_FALLOFF_GLTF: tetralight_light_falloff = 0;
pub const TETRALIGHT_FALLOFF_INVERSE_SQUARE_RANGE: tetralight_light_falloff = 1;
pub const TETRALIGHT_FALLOFF_LINEAR: tetralight_light_falloff = 2;
pub const TETRALIGHT_FALLOFF_LEGACY: tetralight_light_falloff = 3;

/// Which bands of the light vary within a proxy volume (lppv/lppv.h).
pub type tetralight_lppv_quality = u32;
pub const TETRALIGHT_LPPV_LOW: tetralight_lppv_quality = 0;
pub const TETRALIGHT_LPPV_NORMAL: tetralight_lppv_quality = 1;
pub const TETRALIGHT_LPPV_FULL: tetralight_lppv_quality = 2;

/// The positions of the grid points in the box.
pub type tetralight_lppv_placement = u32;
pub const TETRALIGHT_LPPV_CELL_CORNERS: tetralight_lppv_placement = 0;
pub const TETRALIGHT_LPPV_CELL_CENTERS: tetralight_lppv_placement = 1;

/// The slabs of the texture along X (lppv/lppv_texture.h).
pub type tetralight_lppv_layout = u32;
/// SHAr | SHAg | SHAb | occlusion; band 2 is the same for the whole object.
pub const TETRALIGHT_LPPV_FOUR_SLABS: tetralight_lppv_layout = 0;
/// SHAr | SHAg | SHAb | SHBr | SHBg | SHBb | SHC
pub const TETRALIGHT_LPPV_SEVEN_SLABS: tetralight_lppv_layout = 1;

/// RGBA texels of halves or floats.
pub type tetralight_lppv_format = u32;
pub const TETRALIGHT_LPPV_HALF: tetralight_lppv_format = 0;
pub const TETRALIGHT_LPPV_FLOAT: tetralight_lppv_format = 1;

/// The arrays of lightmaps. Texels are ordered by page, row and column; row 0 is at v = 0.
pub type tetralight_lightmap_array = u32;
/// Four halves a texel: irradiance divided by `tetralight_lightmaps_info.scale`, and 1 where a
/// surface is.
pub const TETRALIGHT_LIGHTMAP_IRRADIANCE: tetralight_lightmap_array = 0;
/// 12 halves a texel: the light for normal maps (lightmap/lightmaps.h).
pub const TETRALIGHT_LIGHTMAP_LIGHT: tetralight_lightmap_array = 1;
/// One byte a texel: 255 = its rays hit no back face.
pub const TETRALIGHT_LIGHTMAP_VALIDITY: tetralight_lightmap_array = 2;
/// One half a texel: the relative standard error of its irradiance.
pub const TETRALIGHT_LIGHTMAP_STANDARD_ERROR: tetralight_lightmap_array = 3;
/// Four bytes a texel, 255 = lit.
pub const TETRALIGHT_LIGHTMAP_SHADOW_MASK: tetralight_lightmap_array = 4;
/// One byte a texel: 255 = open.
pub const TETRALIGHT_LIGHTMAP_AMBIENT_OCCLUSION: tetralight_lightmap_array = 5;
/// Text, one name a line, each ended by a line feed.
pub const TETRALIGHT_LIGHTMAP_INSTANCE_NAMES: tetralight_lightmap_array = 6;
/// Text: how the lightmaps were made, a JSON object.
pub const TETRALIGHT_LIGHTMAP_METADATA: tetralight_lightmap_array = 7;

/// One line that says what is wrong and where, ends with '\0'; a longer message is truncated.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_error {
    pub message: [c_char; 512],
}

/// An open probe volume.
#[repr(C)]
pub struct tetralight_volume {
    _data: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// The contents of a volume.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_info {
    pub probe_count: u32,
    pub cell_count: u32,
    /// Cells with this index or a higher one lie outside the hull of the probes.
    pub inner_cell_count: u32,
    /// 0 none, 1 one probe, 2 probes on a line, 3 in a plane, 4 in space.
    pub dimension: u32,
    /// 1 if the volume has baked light and occlusion, else 0.
    pub has_light: u32,
    /// 1 if the volume has baked light and occlusion, else 0.
    pub has_occlusion: u32,
    /// Number of layers, and of weights that `tetralight_recombine` takes.
    pub layer_count: u32,
}

/// A layer of light: the sun, the sky, a light of the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_layer {
    /// For example "light:lamp", ends with '\0'; a longer name is truncated.
    pub name: [c_char; 128],
    /// Its weight in the volume's light; 1 = as baked.
    pub weight: f32,
}

/// The light at one position.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_light {
    /// As TETRALIGHT_SH_PACKED: SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC.
    pub packed: [f32; 28],
    /// Four channels, 1 = lit.
    pub occlusion: [f32; 4],
    /// Barycentric weights of the cell's probes, >= 0; they sum to 1. Walls do not change them.
    pub weights: [f32; 4],
    /// The cell that contains the position, or TETRALIGHT_NO_CELL if the light is ambient.
    pub cell: u32,
}

/// An array of the caller. Element i begins at byte i * stride.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_array {
    pub data: *mut c_void,
    /// Bytes from `data` to the end of the buffer.
    pub size: usize,
    /// Bytes from one element to the next; 0 = elements without gaps.
    pub stride: usize,
}

/// The same for an array that is only read.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_const_array {
    pub data: *const c_void,
    pub size: usize,
    pub stride: usize,
}

/// Many positions in one call. An array whose `data` is NULL is not written.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_batch {
    pub count: usize,
    /// Three floats each, world space.
    pub positions: tetralight_const_array,
    /// uint32_t each, without gaps. In: the cells where searches start. Out: the cells found. May
    /// be NULL.
    pub hints: tetralight_array,
    pub sh: tetralight_array,
    /// A tetralight_sh_format.
    pub sh_format: u32,
    /// Four floats each. Either `sh` or `occlusion` may be NULL.
    pub occlusion: tetralight_array,
    /// A tetralight_outside.
    pub outside: u32,
    /// Metres, > 0; read only if `outside` is TETRALIGHT_AMBIENT.
    pub fade_distance: f32,
    /// A tetralight_walls.
    pub walls: u32,
    /// uint32_t each, without gaps; bit i: what is lit is on rendering layer i, and probes on none
    /// of its layers do not light it. NULL or 0 = all layers.
    pub rendering_layers: tetralight_const_array,
    /// float each, without gaps, metres, >= 0: light of probes behind a wall fades over this
    /// distance. NULL = 0.
    pub radii: tetralight_const_array,
    /// Three floats each, without gaps: unit normals of surfaces that the positions lie on, along
    /// which they are pushed off. Such a batch takes about twice the time. May be NULL.
    pub normals: tetralight_const_array,
    /// The share of the mean distance to the probes that positions with normals are pushed by, >=
    /// 0; TETRALIGHT_NORMAL_OFFSET is a good one.
    pub normal_offset: f32,
}

/// Counts of a batch.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_report {
    /// Positions that are not finite; they receive the ambient light.
    pub not_finite_count: u64,
    /// Cells that the searches tested.
    pub step_count: u64,
}

/// Instances as renderers upload them: one array for each of the seven float4.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_instances {
    pub count: usize,
    pub positions: tetralight_const_array,
    pub hints: tetralight_array,
    /// SHAr, SHAg, SHAb, SHBr, SHBg, SHBb, SHC: float4 each, without gaps.
    pub sh: [tetralight_array; 7],
    /// float4 each; may be NULL.
    pub occlusion: tetralight_array,
    /// As in tetralight_batch.
    pub walls: u32,
    pub rendering_layers: tetralight_const_array,
    pub radii: tetralight_const_array,
}

/// More about a volume.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_details {
    /// The world position that TETRALIGHT_ARRAY_POSITIONS are relative to.
    pub world_origin: [f64; 3],
    /// The box of the probes, world space; all 0 without probes.
    pub low: [f64; 3],
    /// The box of the probes, world space; all 0 without probes.
    pub high: [f64; 3],
    /// 27 floats: the light of positions without a probe.
    pub ambient: [f32; 27],
    /// What TETRALIGHT_ARRAY_HALVES are multiplied by; 0 if they are not there.
    pub half_scale: f32,
    /// 1 if the volume knows which walls hide its probes, else 0.
    pub knows_walls: u32,
    /// 1 if `tetralight_relight_sky`, `tetralight_relight_sun` can change it, else 0.
    pub can_relight_sky: u32,
    /// 1 if `tetralight_relight_sky`, `tetralight_relight_sun` can change it, else 0.
    pub can_relight_sun: u32,
    /// Lights of the scene, for `tetralight_get_scene_light`.
    pub light_count: u32,
}

/// A light of the scene, in the units of glTF; world space.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_scene_light {
    /// Ends with '\0'; a longer name is truncated.
    pub name: [c_char; 128],
    /// A tetralight_light_type, _light_mode and _light_falloff.
    pub r#type: u32,
    /// A tetralight_light_type, _light_mode and _light_falloff.
    pub mode: u32,
    /// A tetralight_light_type, _light_mode and _light_falloff.
    pub falloff: u32,
    /// Its channel of the probes' occlusion, 0 to 3, or TETRALIGHT_NO_CELL.
    pub channel: u32,
    /// The weight of its layer; 1 = as baked.
    pub weight: f32,
    /// Linear RGB times intensity: lux for directional lights, candela for the others.
    pub intensity: [f32; 3],
    pub position: [f32; 3],
    /// The unit vector along which it shines.
    pub direction: [f32; 3],
    /// Metres; 0 = without end.
    pub range: f32,
    /// Cosines of the half angles of a spot light's cone.
    pub cos_inner_cone: f32,
    /// Cosines of the half angles of a spot light's cone.
    pub cos_outer_cone: f32,
    /// Metres; of directional lights half the angle in the sky, radians.
    pub radius: f32,
    /// Of rectangles: the unit vector along the width, and metres.
    pub tangent: [f32; 3],
    pub width: f32,
    pub height: f32,
}

/// Volumes that join and leave while a game runs, and that together light what is between them:
/// streamed cells of a level, prefabs.
///
///     tetralight_joined_create(&joined, &error);
///     const tetralight_volume* volume = tetralight_joined_volume(joined);   // for queries
///     tetralight_joined_add(joined, "hall", hall, &error);
///     while (in_each_frame) {
///         uint32_t is_ready = 0;
///         tetralight_joined_step(joined, 500, &is_ready, &error);
///         if (is_ready) tetralight_joined_commit(joined, &error);
///     }
///
/// Each call must run alone on its `joined`, but queries of its volume may run beside add, remove
/// and step.
#[repr(C)]
pub struct tetralight_joined {
    _data: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// A proxy volume: a grid of light around a large object. Its constants must be finite floats.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_lppv_box {
    /// The transform of the object, by columns.
    pub world_from_box: [f32; 16],
    /// The box in the object's space.
    pub low: [f32; 3],
    /// The box in the object's space.
    pub high: [f32; 3],
    /// Grid points along each axis, 1 to 256.
    pub resolution: [u32; 3],
    /// A tetralight_lppv_placement, _quality, _layout and _format.
    pub placement: u32,
    /// A tetralight_lppv_placement, _quality, _layout and _format.
    pub quality: u32,
    /// A tetralight_lppv_placement, _quality, _layout and _format.
    pub layout: u32,
    /// A tetralight_lppv_placement, _quality, _layout and _format.
    pub format: u32,
}

/// The 3D texture of a proxy volume.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_lppv_size {
    pub texels: [u32; 3],
    pub bytes: usize,
}

/// The uniforms of the texture: TetralightLppvConstants of runtime/shaders/lppv.glsl.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_lppv_constants {
    pub local_from_world: [f32; 16],
    pub params: [f32; 4],
    pub low: [f32; 4],
    pub size_inverse: [f32; 4],
    pub shb_r: [f32; 4],
    pub shb_g: [f32; 4],
    pub shb_b: [f32; 4],
    pub shc: [f32; 4],
}

/// A volume for queries by shaders (runtime/shader_volume.h): arrays that are ready to upload.
#[repr(C)]
pub struct tetralight_shader_volume {
    _data: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// Open lightmaps (lightmap/lightmaps.h).
#[repr(C)]
pub struct tetralight_lightmaps {
    _data: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// The contents of lightmaps.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_lightmaps_info {
    /// Texels along each side of every page.
    pub page_size: u32,
    pub page_count: u32,
    /// Instances of the scene, with or without a lightmap.
    pub instance_count: u32,
    /// 1 if normal maps have an effect, else 0.
    pub has_light: u32,
    /// What halves of textures are multiplied by.
    pub scale: f32,
    /// How mixed lights are in the texels: 0 = bounces, with real-time shadows; 1 = bounces, with a
    /// shadow mask; 2 = bounces and direct light.
    pub mixed_lighting: u32,
    /// 1 if there is ambient occlusion, else 0.
    pub has_ambient_occlusion: u32,
}

/// The place of an instance: uv_page = uv * scale + offset, with the unwrapped uv (TEXCOORD_1) of
/// its mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_lightmap_place {
    pub scale: [f32; 2],
    pub offset: [f32; 2],
    /// Or TETRALIGHT_NO_PAGE; scale and offset are 0 then.
    pub page: u32,
}

/// Open reflection probes (reflection/reflections.h).
#[repr(C)]
pub struct tetralight_reflections {
    _data: [u8; 0],
    _marker: PhantomData<(*mut u8, PhantomPinned)>,
}

/// The contents of reflection probes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_reflections_info {
    /// Texels along each side of a face of level 0; half as many in each further level.
    pub size: u32,
    /// Level i is blurred for the roughness 1 - sqrt(1 - i / (level_count - 1)).
    pub level_count: u32,
    /// Also the number of cubes.
    pub probe_count: u32,
}

/// Where a cube was captured, and where it is used.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_reflection_probe {
    pub position: [f64; 3],
    /// The center of the box relative to the position, metres.
    pub box_center: [f32; 3],
    /// Half of the box along its axes, metres. Infinite: the probe is used everywhere.
    pub half_size: [f32; 3],
    /// Unit vectors in world axes, one after the other.
    pub axes: [f32; 9],
    /// Outside the box the probe fades out over this distance, metres.
    pub blend_distance: f32,
    /// Probes of higher importance hide those of lower importance.
    pub importance: i32,
    /// Fraction of the rays of the cube that hit no back face.
    pub validity: f32,
}

/// The probes that light a position, and their weights, which sum to 1.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct tetralight_reflection_blend {
    pub probes: [u32; 3],
    pub weights: [f32; 3],
}

#[link(name = "tetralight")]
extern "C" {
    /// The version of the library: major * 10000 + minor * 100 + patch. Thread-safe.
    pub fn tetralight_version() -> u32;

    /// The same as text, for example "0.1.0". Thread-safe.
    pub fn tetralight_version_string() -> *const c_char;

    /// Opens a file and verifies all of it: for files from any source. Close `*volume` after use.
    pub fn tetralight_open(path: *const c_char, volume: *mut *mut tetralight_volume, error: *mut tetralight_error) -> tetralight_status;

    /// Opens a file and checks only its header and section table. A corrupt section gives wrong light
    /// or the ambient light, never a read out of range; `tetralight_verify` finds it.
    pub fn tetralight_open_lazy(path: *const c_char, volume: *mut *mut tetralight_volume, error: *mut tetralight_error) -> tetralight_status;

    /// Opens a file that is in memory: of an archive or an asset bundle, from a network. Copies the
    /// bytes, so that they may change or go after the call, and verifies all of them. `bytes` need not
    /// be aligned. Messages begin with "memory". Close `*volume` after use.
    pub fn tetralight_open_memory(bytes: *const c_void, size: usize, volume: *mut *mut tetralight_volume, error: *mut tetralight_error) -> tetralight_status;

    /// Verifies all of a volume that `tetralight_open_lazy` has opened; for a background thread.
    pub fn tetralight_verify(volume: *const tetralight_volume, error: *mut tetralight_error) -> tetralight_status;

    /// Closes a volume; does nothing if it is NULL.
    pub fn tetralight_close(volume: *mut tetralight_volume);

    pub fn tetralight_get_info(volume: *const tetralight_volume, info: *mut tetralight_info, error: *mut tetralight_error) -> tetralight_status;

    pub fn tetralight_get_layer(volume: *const tetralight_volume, index: u32, layer: *mut tetralight_layer, error: *mut tetralight_error) -> tetralight_status;

    /// An array of a volume without a copy, `which` a tetralight_volume_array. `stride` is not 0.
    /// Valid until a call that changes the volume (recombine, relight, close; of joined volumes commit
    /// and destroy).
    /// Returns TETRALIGHT_NOT_THERE if the array is empty: files can hold light as floats, as halves or
    /// both.
    pub fn tetralight_get_array(volume: *const tetralight_volume, which: u32, array: *mut tetralight_const_array, error: *mut tetralight_error) -> tetralight_status;

    /// Cost: one pass over the positions.
    pub fn tetralight_get_details(volume: *const tetralight_volume, details: *mut tetralight_details, error: *mut tetralight_error) -> tetralight_status;

    /// Returns TETRALIGHT_NOT_THERE if there is no such light.
    pub fn tetralight_get_scene_light(volume: *const tetralight_volume, index: u32, light: *mut tetralight_scene_light, error: *mut tetralight_error) -> tetralight_status;

    /// Replaces the light of the volume by the sum of its layers times these weights: one a layer, >=
    /// 0. Must not run at the same time as another call on this volume. Cost: one pass over all layers.
    /// Memory: that of the probes' light. Existing shader volumes and proxy volumes keep their light.
    pub fn tetralight_recombine(volume: *mut tetralight_volume, weights: *const f32, weight_count: usize, error: *mut tetralight_error) -> tetralight_status;

    /// Replaces the sky: layer "sky" becomes the light that the probes transfer from it, and the light
    /// of the volume its sum with the other layers at their weights. `sky`: 48 floats, its radiance as
    /// 16 RGB coefficients of bands 0 to 3, L_i = integral of L Y_i (probes/distant_light.h);
    /// TETRALIGHT_ARRAY_SKY is the present one. Adds the name of this function to member "relit" of
    /// the metadata: `tetralight verify` and bakes that reuse probes then know that the light is not
    /// that of the scene. Returns TETRALIGHT_NOT_THERE if the volume holds no transfer or no layer
    /// "sky". Memory and cost: a copy of the volume.
    pub fn tetralight_relight_sky(volume: *mut tetralight_volume, sky: *const f32, error: *mut tetralight_error) -> tetralight_status;

    /// Moves the sun: layer "sun" becomes the light that the probes transfer from a sun that shines
    /// along the unit vector `direction` (three floats), with `irradiance` (three floats, >= 0) on a
    /// surface that faces it. Of a mixed sun only the bounces: the caller adds the direct light. Its
    /// occlusion is that of the old direction, and it loses its channel. Adds the name of this function
    /// to the metadata, as `tetralight_relight_sky` does. Returns TETRALIGHT_NOT_THERE if the volume
    /// holds no transfer, or not exactly one sun in layer "sun". Memory and cost: a copy of the volume.
    pub fn tetralight_relight_sun(volume: *mut tetralight_volume, direction: *const f32, irradiance: *const f32, error: *mut tetralight_error) -> tetralight_status;

    /// Writes the volume with its present light to a file, which replaces an older one only as a
    /// whole; path "-" is stdout. Sections of the opened file that are not of the volume are left out.
    /// Memory: 1 MiB, to read the file back and compare it. Returns TETRALIGHT_UNSUPPORTED for joined
    /// volumes: save each of them instead. Windows does not replace a file while it is open, here or in
    /// another program: the call returns TETRALIGHT_UNAVAILABLE for the path that the volume was opened
    /// from.
    pub fn tetralight_save(volume: *const tetralight_volume, path: *const c_char, error: *mut tetralight_error) -> tetralight_status;

    /// The light at one position (three floats), of the probes that no wall hides; a batch of one has
    /// more options. `hint`, which may be NULL, gives the cell where the search starts and receives the
    /// cell found. A position that is not finite receives the ambient light and no cell.
    pub fn tetralight_query(volume: *const tetralight_volume, position: *const f32, hint: *mut u32, light: *mut tetralight_light, error: *mut tetralight_error) -> tetralight_status;

    /// The light at many positions. `report` may be NULL.
    pub fn tetralight_query_batch(volume: *const tetralight_volume, batch: *const tetralight_batch, report: *mut tetralight_report, error: *mut tetralight_error) -> tetralight_status;

    /// The light of instances. `report` may be NULL.
    pub fn tetralight_pack_instances(volume: *const tetralight_volume, instances: *const tetralight_instances, report: *mut tetralight_report, error: *mut tetralight_error) -> tetralight_status;

    /// No volumes. Destroy `*joined` after use.
    pub fn tetralight_joined_create(joined: *mut *mut tetralight_joined, error: *mut tetralight_error) -> tetralight_status;

    /// Destroys `joined` and its volume; does nothing if it is NULL.
    pub fn tetralight_joined_destroy(joined: *mut tetralight_joined);

    /// Orders that a volume joins, under a name that no other has. It must not be closed,
    /// recombined or relit until it has left and `tetralight_joined_commit` was called.
    pub fn tetralight_joined_add(joined: *mut tetralight_joined, name: *const c_char, part: *const tetralight_volume, error: *mut tetralight_error) -> tetralight_status;

    /// Orders that a volume leaves.
    pub fn tetralight_joined_remove(joined: *mut tetralight_joined, name: *const c_char, error: *mut tetralight_error) -> tetralight_status;

    /// Works on what was ordered for about this long. `*is_ready` becomes 1 once all of it is done, and
    /// 0 before. All is made anew in one call for the first volumes, for probes in a plane, nearer to
    /// each other than a millimetre, or far outside of those before. If memory is short, the call
    /// returns TETRALIGHT_OUT_OF_RESOURCES, queries go on as before, and the next call begins anew.
    pub fn tetralight_joined_step(joined: *mut tetralight_joined, budget_microseconds: u32, is_ready: *mut u32, error: *mut tetralight_error) -> tetralight_status;

    /// Queries read what is ready from now on. No query may run meanwhile. Without effect if nothing is
    /// ready. Hints from before stay useful.
    pub fn tetralight_joined_commit(joined: *mut tetralight_joined, error: *mut tetralight_error) -> tetralight_status;

    /// The volume that queries read: the same pointer until `joined` is destroyed. It has no layers:
    /// its light is that of the volumes as they joined. NULL if `joined` is NULL.
    pub fn tetralight_joined_volume(joined: *const tetralight_joined) -> *const tetralight_volume;

    /// Packs 27 coefficients of irradiance, all finite, as the 28 floats of TETRALIGHT_SH_PACKED.
    /// Thread-safe.
    pub fn tetralight_pack_sh(coefficients: *const f32, packed: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// Irradiance / pi (three floats) at a unit normal from 28 packed floats, all finite. Times albedo
    /// it is the diffuse exitant radiance. Thread-safe.
    pub fn tetralight_sample_sh9(packed: *const f32, normal: *const f32, rgb: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// The size of a proxy volume's texture. Thread-safe.
    pub fn tetralight_get_lppv_size(r#box: *const tetralight_lppv_box, size: *mut tetralight_lppv_size, error: *mut tetralight_error) -> tetralight_status;

    /// Fills a texture, x fastest, and its constants. Cost: one query per grid point. Allocates.
    pub fn tetralight_fill_lppv(volume: *const tetralight_volume, r#box: *const tetralight_lppv_box, texels: *const tetralight_array, constants: *mut tetralight_lppv_constants, error: *mut tetralight_error) -> tetralight_status;

    /// Makes the arrays. Free `*made` after use. It does not refer to the volume.
    pub fn tetralight_make_shader_volume(volume: *const tetralight_volume, made: *mut *mut tetralight_shader_volume, error: *mut tetralight_error) -> tetralight_status;

    /// One of the arrays, valid until `made` is freed. No array is empty. Thread-safe.
    pub fn tetralight_get_shader_array(made: *const tetralight_shader_volume, index: u32, array: *mut tetralight_const_array, error: *mut tetralight_error) -> tetralight_status;

    /// Frees the arrays; does nothing if `made` is NULL.
    pub fn tetralight_free_shader_volume(made: *mut tetralight_shader_volume);

    /// Opens a file and verifies all of it. Close `*lightmaps` after use. All other calls may run on
    /// one `lightmaps` at the same time, but for close.
    pub fn tetralight_lightmaps_open(path: *const c_char, lightmaps: *mut *mut tetralight_lightmaps, error: *mut tetralight_error) -> tetralight_status;

    /// The same for a file that is in memory. Copies the bytes.
    pub fn tetralight_lightmaps_open_memory(bytes: *const c_void, size: usize, lightmaps: *mut *mut tetralight_lightmaps, error: *mut tetralight_error) -> tetralight_status;

    /// Closes lightmaps; does nothing if they are NULL.
    pub fn tetralight_lightmaps_close(lightmaps: *mut tetralight_lightmaps);

    pub fn tetralight_lightmaps_get_info(lightmaps: *const tetralight_lightmaps, info: *mut tetralight_lightmaps_info, error: *mut tetralight_error) -> tetralight_status;

    /// The place of an instance, by its index in the scene. Returns TETRALIGHT_NOT_THERE if there is no
    /// such instance.
    pub fn tetralight_lightmaps_rectangle(lightmaps: *const tetralight_lightmaps, instance: u32, place: *mut tetralight_lightmap_place, error: *mut tetralight_error) -> tetralight_status;

    /// An array of lightmaps without a copy, `which` a tetralight_lightmap_array; valid until close.
    /// `stride` is not 0. Returns TETRALIGHT_NOT_THERE if the array is empty.
    pub fn tetralight_lightmaps_get_array(lightmaps: *const tetralight_lightmaps, which: u32, array: *mut tetralight_const_array, error: *mut tetralight_error) -> tetralight_status;

    /// Irradiance (three floats) at a place of a page (two floats), bilinear, not divided by pi. With a
    /// unit `normal` (three floats, world space) it is that on this normal, as normal maps give, on a
    /// surface whose own unit normal is `base_normal`. Both may be NULL: the irradiance is that on the
    /// surface. Returns TETRALIGHT_NOT_THERE if there is no such page.
    pub fn tetralight_lightmaps_sample(lightmaps: *const tetralight_lightmaps, page: u32, uv_page: *const f32, base_normal: *const f32, normal: *const f32, irradiance: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// How much of the light of each of the four occlusion channels the texels see at a place of a
    /// page, 0 to 1 (four floats): the shadows of static objects. 1 without a shadow mask. Returns
    /// TETRALIGHT_NOT_THERE if there is no such page.
    pub fn tetralight_lightmaps_shadow_mask(lightmaps: *const tetralight_lightmaps, page: u32, uv_page: *const f32, visible: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// How open the surroundings are at a place of a page, 0 to 1 (one float), which the irradiance
    /// does not include. 1 if it was not baked. Returns TETRALIGHT_NOT_THERE if there is no such page.
    pub fn tetralight_lightmaps_ambient_occlusion(lightmaps: *const tetralight_lightmaps, page: u32, uv_page: *const f32, open: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// Opens a file and verifies all of it. Close `*reflections` after use. All other calls may run on
    /// one `reflections` at the same time, but for close.
    pub fn tetralight_reflections_open(path: *const c_char, reflections: *mut *mut tetralight_reflections, error: *mut tetralight_error) -> tetralight_status;

    /// The same for a file that is in memory. Copies the bytes.
    pub fn tetralight_reflections_open_memory(bytes: *const c_void, size: usize, reflections: *mut *mut tetralight_reflections, error: *mut tetralight_error) -> tetralight_status;

    /// Closes reflection probes; does nothing if they are NULL.
    pub fn tetralight_reflections_close(reflections: *mut tetralight_reflections);

    pub fn tetralight_reflections_get_info(reflections: *const tetralight_reflections, info: *mut tetralight_reflections_info, error: *mut tetralight_error) -> tetralight_status;

    /// Returns TETRALIGHT_NOT_THERE if there is no such probe.
    pub fn tetralight_reflections_get_probe(reflections: *const tetralight_reflections, index: u32, probe: *mut tetralight_reflection_probe, error: *mut tetralight_error) -> tetralight_status;

    /// The texels of a level as an array of cubes is uploaded: four halves each, probe after probe,
    /// face after face (+X, -X, +Y, -Y, +Z, -Z), row after row. Valid until close. Returns
    /// TETRALIGHT_NOT_THERE if there is no such level.
    pub fn tetralight_reflections_texels(reflections: *const tetralight_reflections, level: u32, texels: *mut tetralight_const_array, error: *mut tetralight_error) -> tetralight_status;

    /// The three most important probes at a position (three doubles).
    pub fn tetralight_reflections_blend(reflections: *const tetralight_reflections, position: *const f64, blend: *mut tetralight_reflection_blend, error: *mut tetralight_error) -> tetralight_status;

    /// The radiance (three floats) that a surface of a roughness sees at a position (three doubles) in
    /// a direction (three floats): the view mirrored at its normal.
    pub fn tetralight_reflections_sample(reflections: *const tetralight_reflections, blend: *const tetralight_reflection_blend, position: *const f64, direction: *const f32, roughness: f32, radiance: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// What reflections are multiplied with, so that dark corners do not shine, 0 to 1 (one float): the
    /// luminance of `irradiance` (three floats, not divided by pi), that of light probes or a lightmap
    /// on a unit normal, over that of the cubes on the same normal. 1 for mirrors, below roughness
    /// 0.1; this ratio above 0.5.
    pub fn tetralight_reflections_occlusion(reflections: *const tetralight_reflections, blend: *const tetralight_reflection_blend, normal: *const f32, irradiance: *const f32, roughness: f32, occlusion: *mut f32, error: *mut tetralight_error) -> tetralight_status;

    /// Scale and bias of F0 (two floats) in the reflectance of a surface, for a table over n . v and
    /// roughness, both 0 to 1. `sample_count` > 0; 256 is a good one.
    pub fn tetralight_split_sum(n_dot_v: f32, roughness: f32, sample_count: u32, scale_and_bias: *mut f32, error: *mut tetralight_error) -> tetralight_status;
}
