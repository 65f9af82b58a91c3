// SPDX-License-Identifier: Apache-2.0
//! query VOLUME X Y Z: the cell of a position, its irradiance / pi on a surface that faces up, and
//! the probes of the volume. Opens the volume from memory.
use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::{env, fs, process, ptr};

use tetralight_sys::*;

/// The message of a call that failed.
fn message(error: &tetralight_error) -> String {
    // SAFETY: the library ends every message with a zero byte.
    unsafe { CStr::from_ptr(error.message.as_ptr()) }.to_string_lossy().into_owned()
}

/// An open volume, which closes itself.
struct Volume(*mut tetralight_volume);

impl Volume {
    fn open(bytes: &[u8]) -> Result<Volume, String> {
        let mut volume = ptr::null_mut();
        let mut error = tetralight_error { message: [0; 512] };
        // SAFETY: the pointers lead to memory of the sizes that the call is given.
        let status = unsafe {
            tetralight_open_memory(bytes.as_ptr().cast(), bytes.len(), &mut volume, &mut error)
        };
        if status == TETRALIGHT_OK { Ok(Volume(volume)) } else { Err(message(&error)) }
    }

    fn info(&self) -> Result<tetralight_info, String> {
        let mut info = MaybeUninit::uninit();
        let mut error = tetralight_error { message: [0; 512] };
        // SAFETY: the volume is open; a call that succeeds has written all of `info`.
        match unsafe { tetralight_get_info(self.0, info.as_mut_ptr(), &mut error) } {
            TETRALIGHT_OK => Ok(unsafe { info.assume_init() }),
            _ => Err(message(&error)),
        }
    }

    fn query(&self, position: [f32; 3]) -> Result<tetralight_light, String> {
        let mut light = MaybeUninit::uninit();
        let mut error = tetralight_error { message: [0; 512] };
        // SAFETY: the volume is open; a call that succeeds has written all of `light`.
        let status = unsafe {
            let hint = ptr::null_mut();
            tetralight_query(self.0, position.as_ptr(), hint, light.as_mut_ptr(), &mut error)
        };
        if status == TETRALIGHT_OK { Ok(unsafe { light.assume_init() }) } else { Err(message(&error)) }
    }
}

impl Drop for Volume {
    fn drop(&mut self) {
        // SAFETY: it is open, and nothing uses it after.
        unsafe { tetralight_close(self.0) }
    }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let (path, x, y, z) = match arguments {
        [path, x, y, z] => (path, x, y, z),
        _ => return Err("usage: query VOLUME X Y Z".into()),
    };
    let number = |text: &String| text.parse::<f32>().map_err(|e| format!("{text}: {e}"));
    let bytes = fs::read(path).map_err(|e| format!("{path}: {e}"))?;
    let volume = Volume::open(&bytes)?;
    let light = volume.query([number(x)?, number(y)?, number(z)?])?;
    let (up, mut rgb) = ([0.0f32, 1.0, 0.0], [0.0f32; 3]);
    let mut error = tetralight_error { message: [0; 512] };
    // SAFETY: 28, three and three floats.
    let status = unsafe {
        let (packed, rgb) = (light.packed.as_ptr(), rgb.as_mut_ptr());
        tetralight_sample_sh9(packed, up.as_ptr(), rgb, &mut error)
    };
    if status != TETRALIGHT_OK {
        return Err(message(&error));
    }
    println!("{} {:.6} {:.6} {:.6} {}", light.cell, rgb[0], rgb[1], rgb[2], volume.info()?.probe_count);
    Ok(())
}

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if let Err(message) = run(&arguments) {
        eprintln!("{message}");
        process::exit(1);
    }
}
