# SPDX-License-Identifier: Apache-2.0
"""The C API as Rust: declarations, and a program that prints the layout of every struct."""

KEYWORDS = {"as", "box", "const", "fn", "in", "loop", "match", "mod", "move", "mut", "ref", "type",
            "use", "where"}
SCALARS = {"char": "c_char", "float": "f32", "double": "f64", "int32_t": "i32", "uint32_t": "u32",
           "uint64_t": "u64", "size_t": "usize", "void": "c_void"}

HEAD = """// SPDX-License-Identifier: Apache-2.0
// Written by packages/bindings/generate.py from runtime/tetralight.h: change that header.
{doc}
#![allow(non_camel_case_types)]

use std::marker::{{PhantomData, PhantomPinned}};
use std::os::raw::{{c_char, c_void}};
"""


def name_of(name):
    return f"r#{name}" if name in KEYWORDS else name


def comment(doc, indent="", mark="///"):
    return "".join(f"{indent}{mark} {line}".rstrip() + "\n" for line in doc.split("\n")) if doc else ""


def number(text):
    return (text.rstrip("f"), "f32") if "." in text else (text.rstrip("u"), "u32")


def type_of(type_, count=0):
    text = SCALARS.get(type_.name, type_.name)
    for star in range(type_.stars):
        text = f"*{'const' if type_.is_const and star == 0 else 'mut'} {text}"
    return f"[{text}; {count}]" if count else text


def constants(header):
    for constant in header.constants:
        value, type_ = number(constant.value)
        yield f"{comment(constant.doc)}pub const {constant.name}: {type_} = {value};\n"
    for enum in header.enums:
        text = f"{comment(enum.doc)}pub type {enum.name} = u32;\n"
        for value in enum.values:
            text += f"{comment(value.doc)}pub const {value.name}: {enum.name} = {value.value};\n"
        yield text


def struct(declared):
    if declared.members is None:
        return (f"{comment(declared.doc)}#[repr(C)]\npub struct {declared.name} {{\n    _data: [u8; 0],\n"
                "    _marker: PhantomData<(*mut u8, PhantomPinned)>,\n}\n")
    text = f"{comment(declared.doc)}#[repr(C)]\n#[derive(Clone, Copy, Debug)]\npub struct {declared.name} {{\n"
    for member in declared.members:
        text += comment(member.doc, "    ")
        text += f"    pub {name_of(member.name)}: {type_of(member.type, member.count)},\n"
    return text + "}\n"


def function(declared):
    parameters = ", ".join(f"{name_of(p.name)}: {type_of(p.type)}" for p in declared.parameters)
    is_void = declared.result.name == "void" and declared.result.stars == 0
    result = "" if is_void else f" -> {type_of(declared.result)}"
    return f"{comment(declared.doc, '    ')}    pub fn {declared.name}({parameters}){result};\n"


def crate(header):
    """The text of src/lib.rs."""
    parts = [HEAD.format(doc=comment(as_markdown(header.doc), mark="//!").rstrip())]
    parts += constants(header)
    parts += map(struct, header.structs)
    functions = "\n".join(map(function, header.functions))
    parts.append(f'#[link(name = "tetralight")]\nextern "C" {{\n{functions}}}\n')
    return "\n".join(parts)


def as_markdown(doc):
    """Indented lines are C, not the Rust that rustdoc takes them for."""
    lines, is_code = [], False
    for line in doc.split("\n"):
        if line and line.startswith("    ") != is_code:
            is_code = not is_code
            lines.insert(len(lines) if is_code else len(lines) - 1, "```c" if is_code else "```")
        lines.append(line[4:] if is_code else line)
    return "\n".join(lines + ["```"] * is_code)


def cargo(version):
    """The text of Cargo.toml."""
    return f"""# Written by packages/bindings/generate.py.
[package]
name = "tetralight-sys"
version = "{version}"
edition = "2021"
rust-version = "1.63"
license = "Apache-2.0"
description = "Baked light probes at run time: the C API of Tetralight"
links = "tetralight"
"""


def layout(header):
    """A program that prints size, alignment and offsets of every struct."""
    lines = []
    for declared in header.structs:
        if declared.members is None:
            continue
        name = declared.name
        lines.append(f'    println!("{name} {{}} {{}}", size_of::<{name}>(), align_of::<{name}>());')
        lines.append(f"    let s = MaybeUninit::<{name}>::uninit();\n    let p = s.as_ptr();")
        for member in declared.members:
            lines.append(f'    println!("{name}.{member.name} {{}}", '
                         f"unsafe {{ addr_of!((*p).{name_of(member.name)}) as usize }} - p as usize);")
    body = "\n".join(lines)
    return ("use std::mem::{align_of, size_of, MaybeUninit};\nuse std::ptr::addr_of;\n"
            f"use tetralight_sys::*;\n\nfn main() {{\n{body}\n}}\n")
