# SPDX-License-Identifier: Apache-2.0
"""The C API as C#: declarations, and a program that prints the layout of every struct."""

KEYWORDS = {"base", "event", "fixed", "in", "is", "object", "out", "params", "ref", "string"}
SCALARS = {"char": "byte", "float": "float", "double": "double", "int32_t": "int",
           "uint32_t": "uint", "uint64_t": "ulong", "size_t": "UIntPtr", "void": "void"}

HEAD = """// SPDX-License-Identifier: Apache-2.0
// Written by packages/bindings/generate.py from runtime/tetralight.h: change that header.
{doc}
// Compile it with /unsafe, and with TETRALIGHT_WINDOWS, TETRALIGHT_MACOS or TETRALIGHT_STATIC where the
// library is not libtetralight.so.0. Texts are UTF-8 and end with a zero byte.
using System;
using System.Runtime.InteropServices;

namespace Tetralight
{{
"""
LIBRARY = """        /// <summary>The file of the library.</summary>
#if TETRALIGHT_WINDOWS
        public const string Library = "tetralight-{abi}";
#elif TETRALIGHT_MACOS
        public const string Library = "libtetralight.{abi}.dylib";
#elif TETRALIGHT_STATIC
        public const string Library = "__Internal";
#else
        public const string Library = "libtetralight.so.{abi}";
#endif
"""


def name_of(name):
    return f"@{name}" if name in KEYWORDS else name


def comment(doc, indent="    "):
    if not doc:
        return ""
    text = doc.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    lines = f"<summary>{text}</summary>".split("\n")
    return "".join(f"{indent}/// {line}".rstrip() + "\n" for line in lines)


def type_of(type_):
    return SCALARS.get(type_.name, type_.name) + "*" * type_.stars


def enum(declared):
    text = f"{comment(declared.doc)}    public enum {declared.name} : uint\n    {{\n"
    for value in declared.values:
        text += f"{comment(value.doc, ' ' * 8)}        {value.name} = {value.value},\n"
    return text + "    }\n"


def member(declared):
    """The lines of a member: C# has arrays of numbers in structs, but not of structs."""
    type_, name = type_of(declared.type), name_of(declared.name)
    doc = comment(declared.doc, " " * 8)
    if declared.count == 0:
        return f"{doc}        public {type_} {name};\n"
    if declared.type.name in SCALARS and declared.type.stars == 0:
        return f"{doc}        public fixed {type_} {name}[{declared.count}];\n"
    names = ", ".join(f"{declared.name}{i}" for i in range(declared.count))
    return f"{doc}        public {type_} {names};\n"


def struct(declared):
    if declared.members is None:
        return f"{comment(declared.doc)}    public struct {declared.name}\n    {{\n    }}\n"
    members = "".join(map(member, declared.members))
    return (f"{comment(declared.doc)}    [StructLayout(LayoutKind.Sequential)]\n"
            f"    public unsafe struct {declared.name}\n    {{\n{members}    }}\n")


def constant(declared):
    type_ = "float" if "." in declared.value else "uint"
    return f"{comment(declared.doc, ' ' * 8)}        public const {type_} {declared.name} = {declared.value};\n"


def function(declared):
    parameters = ", ".join(f"{type_of(p.type)} {name_of(p.name)}" for p in declared.parameters)
    return (f"{comment(declared.doc, ' ' * 8)}"
            "        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]\n"
            f"        public static extern {type_of(declared.result)} {declared.name}({parameters});\n")


def source(header, abi):
    """The text of Tetralight.cs."""
    doc = "\n".join(f"// {line}".rstrip() for line in header.doc.split("\n"))
    native = [LIBRARY.format(abi=abi), *map(constant, header.constants),
              *map(function, header.functions)]
    parts = [*map(enum, header.enums), *map(struct, header.structs),
             "    /// <summary>The functions and constants of the C API.</summary>\n"
             "    public static unsafe class Native\n    {\n" + "\n".join(native) + "    }\n"]
    return HEAD.format(doc=doc) + "\n".join(parts) + "}\n"


def layout(header):
    """A program that prints size and offsets of every struct. Alignments are those of C: Mono does
    not say them."""
    lines = []
    for declared in header.structs:
        if declared.members is None:
            continue
        name = declared.name
        lines.append(f'        Console.WriteLine("{name} {{0}}", Marshal.SizeOf(typeof({name})));')
        for m in declared.members:
            is_split = m.count and not (m.type.name in SCALARS and m.type.stars == 0)
            field = f"{m.name}0" if is_split else m.name
            lines.append(f'        Console.WriteLine("{name}.{m.name} {{0}}", '
                         f'Marshal.OffsetOf(typeof({name}), "{field}"));')
    body = "\n".join(lines)
    return ("using System;\nusing System.Runtime.InteropServices;\nusing Tetralight;\n\n"
            f"class Layout\n{{\n    static void Main()\n    {{\n{body}\n    }}\n}}\n")
