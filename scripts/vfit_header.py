"""Reads include/vfit.h into plain values: enums, structs, callbacks, handles, functions and their comments.

    python3 scripts/vfit_header.py      prints them as JSON

A generator of a binding starts here. A line that is not understood stops the reading: a binding that silently
lacks a function is worse than none.
"""

import json
import pathlib
import re
from typing import NamedTuple


class Variable(NamedTuple):
    """A field or parameter: const char* path, float fx, char name[64]."""

    type: str  # "float", "vfit_camera", ...
    pointer: bool
    const: bool
    name: str
    length: int  # of an array, else 0
    doc: str


class Item(NamedTuple):
    name: str
    value: int
    doc: str


class Enum(NamedTuple):
    type: str  # its typedef, or "" for a set of flags
    prefix: str  # what all of its names start with: "VFIT_JOINT_"
    items: list
    doc: str


class Struct(NamedTuple):
    name: str
    fields: list
    doc: str


class Function(NamedTuple):
    name: str
    result: str
    parameters: list
    doc: str

    def output_list(self):
        """First parameter and number of parameters of the list that the function fills: items, stride (if
        any) and a pointer to the count. None where it fills none."""
        for at, count in enumerate(self.parameters):
            length = 3 if at and self.parameters[at - 1].name.endswith("stride") else 2
            if at + 1 < length or not (count.pointer and count.name.endswith("count")):
                continue
            items = self.parameters[at + 1 - length]
            if items.pointer and not items.const and items.type not in ("void", "char", "uint8_t"):
                return at + 1 - length, length
        return None


class Header(NamedTuple):
    version: str  # as an expression of VFIT_MAKE_VERSION: "0, 1, 0"
    counts: dict  # "VFIT_BONE_COUNT" -> 22
    handles: list
    enums: list
    structs: list
    callbacks: list
    functions: list


TOKEN = re.compile(
    r"""
    (?P<comment>/\*.*?\*/)
  | (?P<handle>VFIT_HANDLE\((?P<handle_name>\w+)\)\s*;)
  | (?P<init>VFIT_STRUCT\(\w+\))
  | (?P<alias>typedef\s+int32_t\s+(?P<alias_name>\w+)\s*;)
  | (?P<enum>enum\s*\{(?P<enum_body>.*?)\}\s*;)
  | (?P<struct>typedef\s+struct\s+(?P<struct_name>\w+)\s*\{(?P<struct_body>.*?)\}\s*(?P=struct_name)\s*;)
  | (?P<callback>typedef\s+(?P<callback_result>\w+\s*\**)\s*
      \(\*(?P<callback_name>\w+)\)\s*\((?P<callback_body>.*?)\)\s*;)
  | (?P<function>VFIT_API\s+(?P<result>(?:const\s+)?\w+\s*\**)\s*(?P<name>\w+)\s*\((?P<body>.*?)\)\s*;)
""",
    re.X | re.S,
)


def prose(comment):
    """The text of a comment on one line."""
    lines = comment[2:-2].splitlines()
    return " ".join(
        filter(None, (line.strip().removeprefix("* ").removeprefix("*").strip() for line in lines))
    )


def variables(declaration, doc):
    """float fx, fy -> two of them."""
    plain = " ".join(declaration.split())
    match = re.fullmatch(r"(const )?(?:struct )?(\w+)\s*(.*)", plain)
    const, kind, rest = match.groups()
    for part in rest.split(","):
        name, star, length = re.fullmatch(r"\s*(\**)\s*(\w+)\s*(?:\[(\d+)\])?\s*", part).group(2, 1, 3)
        yield Variable(kind, bool(star), bool(const), name, int(length or 0), doc)


def parameters(body):
    body = re.sub(r"/\*.*?\*/", "", body, flags=re.S).strip()
    if body in ("", "void"):
        return []
    found = [next(variables(part, "")) for part in body.split(",")]
    return [v._replace(pointer=v.pointer or v.length > 0) for v in found]  # an array is passed as a pointer


def split_with_comments(body, separator):
    """Pieces of a body, each with the comment that stands behind it."""
    pieces, text = [], ""
    for part in re.split(r"(/\*.*?\*/|" + re.escape(separator) + ")", body, flags=re.S):
        if part.startswith("/*"):
            if text.strip():
                pieces.append([text.strip(), prose(part)])  # the last one needs no separator
                text = ""
            elif pieces:
                pieces[-1][1] = " ".join(filter(None, (pieces[-1][1], prose(part))))
        elif part == separator:
            if text.strip():
                pieces.append([text.strip(), ""])
            text = ""
        else:
            text += part
    if text.strip():
        pieces.append([text.strip(), ""])
    return pieces


def common_prefix(names):
    words = [name.split("_") for name in names]
    shared = []
    for column in zip(*words):
        if len(set(column)) > 1:
            break
        shared.append(column[0])
    return "_".join(shared[: len(min(words, key=len)) - 1]) + "_"


def read_enum(body, doc):
    items = []
    for text, item_doc in split_with_comments(body, ","):
        name, value = (t.strip() for t in text.split("="))
        items.append(Item(name, int(value, 0), item_doc))
    return Enum("", common_prefix([i.name for i in items]), items, doc)


def named(enum, alias):
    """The enum, if the typedef beside it is its own: they share the word after vfit."""
    words = enum.prefix.lower().strip("_").split("_")[1:]
    if words and not set(words) & set(alias.split("_")):
        return None
    prefix = enum.prefix
    if alias == "vfit_result":
        prefix = "VFIT_"
    return enum._replace(type=alias, prefix=prefix)


def read_header(text):
    version = re.search(r"#define VFIT_VERSION VFIT_MAKE_VERSION\((.*?)\)", text).group(1)
    counts = {n: int(v) for n, v in re.findall(r"#define (VFIT_\w+_COUNT) (\d+)u", text)}
    text = re.sub(
        r"^#(?:.*\\\n)*.*$", "VFIT_STRUCT(_)", text, flags=re.M
    )  # its comment is not the next declaration's
    header = Header(version, counts, [], [], [], [], [])
    comment, alias, untyped, last, position = "", None, None, None, 0
    while True:
        gap = re.compile(r"\s*").match(text, position)
        if gap.end() == len(text):
            return header
        token = TOKEN.match(text, gap.end())
        if not token:
            line = text[gap.end() :].splitlines()[0]
            raise SystemExit(f"vfit.h: not understood: {line}")
        position = token.end()
        if token["comment"]:
            found = prose(token["comment"])
            if last is not None and "\n" not in gap.group():  # behind a declaration, on its line
                attach(header, last, found)
            else:
                comment = "" if found.startswith("----") else found
            continue
        last = None
        if token["init"]:
            comment = ""
        elif token["handle"]:
            header.handles.append(token["handle_name"])
        elif token["alias"]:
            alias_name = token["alias_name"]
            enum = untyped and named(header.enums[untyped - 1], alias_name)
            # Before its enum or right behind it; the one that comes is asked first.
            alias = (alias_name, enum, untyped, comment)
            following = TOKEN.match(text, re.compile(r"(?:\s|/\*.*?\*/)*", re.S).match(text, position).end())
            ahead = (
                following and following["enum"] and named(read_enum(following["enum_body"], ""), alias_name)
            )
            if not ahead:
                if not enum:
                    raise SystemExit(f"vfit.h: no enum beside {alias_name}")
                header.enums[untyped - 1] = enum
                alias = None
            untyped = None
        elif token["enum"]:
            enum = read_enum(token["enum_body"], alias[3] if alias and not comment else comment)
            if alias:
                enum = named(enum, alias[0])
            header.enums.append(enum)
            untyped = None if alias else len(header.enums)
            alias, comment, last = None, "", ("enum", len(header.enums) - 1)
        elif token["struct"]:
            fields = []
            for declaration, doc in split_with_comments(token["struct_body"], ";"):
                fields += variables(declaration, doc)
            header.structs.append(Struct(token["struct_name"], fields, comment))
            comment, untyped, last = "", None, ("struct", len(header.structs) - 1)
        elif token["callback"]:
            header.callbacks.append(
                Function(
                    token["callback_name"],
                    token["callback_result"].replace(" ", ""),
                    parameters(token["callback_body"]),
                    comment,
                )
            )
            comment, untyped = "", None
        elif token["function"]:
            header.functions.append(
                Function(
                    token["name"],
                    token["result"].replace("const ", "").replace(" ", ""),
                    parameters(token["body"]),
                    comment,
                )
            )
            comment, untyped, last = "", None, ("function", len(header.functions) - 1)


def attach(header, last, doc):
    """A comment on the line of what it is about: of the last name of an enum, or of a function."""
    kind, index = last
    if kind == "enum":
        enum = header.enums[index]
        item = enum.items[-1]
        enum.items[-1] = item._replace(doc=" ".join(filter(None, (item.doc, doc))))
    elif kind == "struct":
        header.structs[index] = header.structs[index]._replace(
            doc=" ".join(filter(None, (header.structs[index].doc, doc)))
        )
    else:
        function = header.functions[index]
        header.functions[index] = function._replace(doc=" ".join(filter(None, (function.doc, doc))))


def plain(value):
    """Named tuples as dictionaries; a function also says which of its parameters are a list that it fills."""
    if isinstance(value, list):
        return [plain(item) for item in value]
    if not hasattr(value, "_asdict"):
        return value
    fields = {name: plain(field) for name, field in value._asdict().items()}
    if isinstance(value, Function):
        fields["output_list"] = value.output_list()
    return fields


if __name__ == "__main__":
    path = pathlib.Path(__file__).resolve().parent.parent / "include" / "vfit.h"
    print(json.dumps(plain(read_header(path.read_text(encoding="utf-8"))), indent=1))
