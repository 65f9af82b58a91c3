# SPDX-License-Identifier: Apache-2.0
"""Reads runtime/tetralight.h: its constants, enumerations, structs and functions.

It knows the C that this header is written in and nothing else. What it does not know is an error
that names the line, so that no declaration is left out unseen.
"""
import re
from dataclasses import dataclass, field

# Between these the header declares; before and after them are includes, macros and `extern "C"`.
BEGIN = "#define TETRALIGHT_NOEXCEPT\n#endif\n"
END = "\n#ifdef __cplusplus\n}\n#endif\n"
TOKEN = re.compile(r"""
    (?P<comment>/\*.*?\*/)
  | (?P<directive>^\#(?:[^\n\\]|\\\n|\\.)*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<number>0[xX][0-9a-fA-F]+u?|\d+\.\d+f|\d+u?)
  | (?P<sign>[{}()\[\];,=*])
  | (?P<space>\s+)
""", re.X | re.S | re.M)
SCALARS = {"char", "float", "double", "int32_t", "uint32_t", "uint64_t", "size_t"}


class HeaderError(Exception):
    pass


@dataclass
class Type:
    """A C type: `name` with `stars` asterisks behind it. `is_const`: `name` stands behind `const`."""
    name: str
    stars: int = 0
    is_const: bool = False


@dataclass
class Variable:
    """A member of a struct or a parameter of a function. `count` is 0 for what is not an array."""
    name: str
    type: Type
    count: int = 0
    doc: str = ""


@dataclass
class Constant:
    name: str
    value: str
    doc: str = ""


@dataclass
class Enum:
    name: str
    values: list
    doc: str = ""


@dataclass
class Struct:
    """`members` is None for a struct that only the library knows."""
    name: str
    members: list = None
    doc: str = ""


@dataclass
class Function:
    name: str
    result: Type
    parameters: list
    doc: str = ""


@dataclass
class Header:
    doc: str = ""
    constants: list = field(default_factory=list)
    enums: list = field(default_factory=list)
    structs: list = field(default_factory=list)
    functions: list = field(default_factory=list)


@dataclass
class Token:
    kind: str
    text: str
    line: int


def tokens_of(text, at, end):
    while at < end:
        match = TOKEN.match(text, at, end)
        line = text.count("\n", 0, at) + 1
        if not match:
            raise HeaderError(f"line {line}: {text[at:at + 20]!r} is not known")
        if match.lastgroup != "space":
            yield Token(match.lastgroup, match[0], line)
        at = match.end()


def doc_of(comment):
    """The text of a comment, in lines as they are."""
    inner = re.sub(r"^/\*+|\*+/$", "", comment)
    lines = [re.sub(r"^\s*\* ?", "", line).rstrip() for line in inner.strip().split("\n")]
    return "\n".join(lines).strip()


class Parser:
    def __init__(self, text):
        begin, end = text.find(BEGIN), text.rfind(END)
        if begin < 0 or end < begin:
            raise HeaderError("the macros around the declarations are not known")
        self.tokens = list(tokens_of(text, begin + len(BEGIN), end))
        self.tokens.append(Token("end", "the end", text.count("\n", 0, end) + 1))
        self.at = 0
        self.doc = ""
        self.header = Header(doc_of(re.search(r"/\*.*?\*/", text, re.S)[0]))
        self.numbers = {}  # of macros, for the sizes of arrays
        self.types = set(SCALARS)

    # Tokens

    def fail(self, wanted):
        token = self.tokens[self.at]
        raise HeaderError(f"line {token.line}: {token.text!r} where {wanted} is expected")

    def peek(self):
        while self.tokens[self.at].kind == "comment":
            self.doc = doc_of(self.tokens[self.at].text)
            self.at += 1
        return self.tokens[self.at]

    def take(self, *texts, kind=None):
        token = self.peek()
        if (texts and token.text not in texts) or (kind and token.kind != kind):
            self.fail(" or ".join(texts) or f"a {kind}")
        self.at += 1
        return token.text

    def accept(self, text):
        if self.peek().text != text:
            return False
        self.at += 1
        return True

    def take_doc(self):
        """The comment before this token."""
        self.peek()
        doc, self.doc = self.doc, ""
        return doc

    # Declarations

    def parse(self):
        while self.peek().kind != "end":
            self.declaration()
        return self.header

    def declaration(self):
        doc = self.take_doc()
        token = self.peek()
        if token.kind == "directive":
            self.constant(doc)
        elif token.text == "typedef":
            self.typedef(doc)
        elif token.text == "TETRALIGHT_API":
            self.function(doc)
        else:
            self.fail("a declaration")

    def constant(self, doc):
        match = re.fullmatch(r"#define (\w+) (\S+)", self.peek().text)
        if not match or not TOKEN.fullmatch(match[2]):
            self.fail("#define NAME VALUE")
        self.at += 1
        self.header.constants.append(Constant(match[1], match[2], doc))
        if match[2].isdigit():
            self.numbers[match[1]] = int(match[2])

    def typedef(self, doc):
        self.take("typedef")
        kind = self.take("enum", "struct")
        name = self.take(kind="name")
        if kind == "enum":
            self.header.enums.append(Enum(name, self.enumerators(), doc))
        elif self.peek().text == "{":
            self.header.structs.append(Struct(name, self.members(), doc))
        else:
            self.header.structs.append(Struct(name, None, doc))
        self.take(name)
        self.take(";")
        self.types.add(name)

    def enumerators(self):
        values = []
        self.take("{")
        while not self.accept("}"):
            doc = self.take_doc()
            name = self.take(kind="name")
            self.take("=")
            values.append(Constant(name, self.take(kind="number"), doc))
            if self.peek().text != "}":
                self.take(",")
        return values

    def members(self):
        members = []
        self.take("{")
        while not self.accept("}"):
            doc = self.take_doc()
            type_ = self.type()
            while True:
                members.append(Variable(self.take(kind="name"), type_, self.array_size(), doc))
                if not self.accept(","):
                    break
            self.take(";")
        return members

    def array_size(self):
        if not self.accept("["):
            return 0
        text = self.take()
        self.take("]")
        size = self.numbers.get(text) or (int(text) if text.isdigit() else 0)
        if size == 0:
            self.fail("a size")
        return size

    def type(self):
        is_const = self.accept("const")
        name = self.take(kind="name")
        if name != "void" and name not in self.types:
            self.at -= 1
            self.fail("a type")
        stars = 0
        while self.accept("*"):
            stars += 1
        if name == "void" and stars == 0 and is_const:
            self.fail("a pointer")
        return Type(name, stars, is_const)

    def function(self, doc):
        self.take("TETRALIGHT_API")
        result = self.type()
        name = self.take(kind="name")
        self.take("(")
        parameters = []
        if self.peek().text == "void" and self.tokens[self.at + 1].text == ")":
            self.at += 1
        else:
            while True:
                type_ = self.type()
                parameters.append(Variable(self.take(kind="name"), type_))
                if not self.accept(","):
                    break
        self.take(")")
        self.take("TETRALIGHT_NOEXCEPT")
        self.take(";")
        self.header.functions.append(Function(name, result, parameters, doc))


def read_header(text):
    """The declarations of the header's text. Raises HeaderError where it does not know the C."""
    return Parser(text).parse()
