// SPDX-License-Identifier: Apache-2.0
//! Says where libtetralight is: in TETRALIGHT_LIB_DIR, else where pkg-config finds it.
use std::env;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=TETRALIGHT_LIB_DIR");
    if let Ok(folder) = env::var("TETRALIGHT_LIB_DIR") {
        println!("cargo:rustc-link-search=native={folder}");
        return;
    }
    let found = Command::new("pkg-config").args(["--libs-only-L", "tetralight-shared"]).output();
    let flags = found.map_or(Vec::new(), |output| output.stdout);
    for flag in String::from_utf8_lossy(&flags).split_whitespace() {
        if let Some(folder) = flag.strip_prefix("-L") {
            println!("cargo:rustc-link-search=native={folder}");
        }
    }
}
