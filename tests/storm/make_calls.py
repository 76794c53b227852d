#!/usr/bin/env python3
"""Writes the storm's calls for include/vfit.h as it is now: one random call of each function, one random
filling of each struct.

    make_calls.py ../../include/vfit.h FOLDER       writes handles.h and calls.h

What an argument may be follows from its type and from its neighbours (items, stride, count; buffer,
capacity). A function whose arguments are not understood stops the writing, so that none is left out.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
from vfit_header import read_header  # noqa: E402

CELLS = {"uint32_t", "int32_t", "uint64_t", "int64_t", "float", "double"}


class Writer:
    def __init__(self, header):
        self.header = header
        self.structs = {s.name for s in header.structs}
        self.callbacks = {c.name for c in header.callbacks}
        self.ranges = {
            e.type: (min(i.value for i in e.items), max(i.value for i in e.items))
            for e in header.enums
            if e.type
        }

    def kinds(self):
        """Handle types, each with what lets go of it."""
        functions = {f.name for f in self.header.functions}
        for handle in self.header.handles:
            end = next(handle + e for e in ("_destroy", "_close", "_release") if handle + e in functions)
            yield f"    X({handle}, {end}) \\\n"

    def field(self, v):
        if v.type in self.callbacks or v.name == "struct_size":
            return ""
        if v.pointer and v.type == "char":
            return f"    t.{v.name} = s.text(\"{v.name}\");\n"
        if v.pointer and v.type in self.structs:
            return f"    t.{v.name} = s.struct_in<{v.type}>();\n"
        if v.pointer:
            return ""  # memory of the host: what it may be is told by hand
        if v.type == "char":
            return f"    s.letters(t.{v.name});\n"
        if v.type in self.structs:
            raise SystemExit(f"a struct inside another: {v.name}")
        place = f"t.{v.name}"
        loop = f"    for (auto& x : t.{v.name}) " if v.length else "    "
        if v.length:
            place = "x"
        if v.type in self.ranges:
            low, high = self.ranges[v.type]
            return f"{loop}s.put_enum({place}, {low}, {high});\n"
        return f"{loop}s.put({place}, \"{v.name}\");\n"

    def filling(self, struct):
        body = "".join(self.field(v) for v in struct.fields)
        return f"inline void fill(Storm& s, {struct.name}& t) {{\n    (void)s;\n    (void)t;\n{body}}}\n"

    def arguments(self, f):
        """Lines that draw them, and what is passed."""
        lines, passed, kept, made = [], [], [], []
        p, i = f.parameters, 0
        while i < len(p):
            v, name = p[i], f"a{i}"
            following = p[i + 1] if i + 1 < len(p) else None

            def take(maker, fields):
                nonlocal i
                lines.append(f"auto {name} = {maker};")
                passed.extend(f"{name}.{field}" for field in fields)
                i += len(fields)

            if v.type in self.header.handles:
                if v.pointer and v.const:
                    take(f"s.handles_in<{v.type}>()", ["handles", "count"])
                    continue
                if v.pointer:
                    take(f"s.handle_out<{v.type}>()", ["place"])
                    kept.append(name)
                    continue
                drawn = f"s.handle<{v.type}>()"
            elif v.pointer and following and following.name.endswith("stride"):
                direction = "in" if v.const else "out"
                take(f"s.list_{direction}<{v.type}>()", ["items", "stride", "count"])
                continue
            elif v.type == "float" and v.const and following and following.name == "vertex_count":
                take("s.points_in()", ["positions", "count"])
                continue
            elif v.type == "float" and v.const and following and i + 2 < len(p) and p[i + 2].name == "count":
                take("s.pairs_in()", ["here", "there", "count"])
                continue
            elif v.type in self.ranges and v.pointer and following and following.name == "count":
                take(f"s.plain_list_out<{v.type}>()", ["items", "count"])
                continue
            elif v.type == "void" and following and following.name == "byte_count":
                if v.const:
                    take(f"s.bytes_in(\"{f.name}\")", ["data", "count"])
                else:
                    take("s.bytes_out()", ["data", "count"])
                    made.append(name)
                continue
            elif v.type == "char" and not v.const:
                if following.pointer:
                    take("s.bytes_out()", ["text", "count"])
                    made.append(name)
                else:
                    take("s.buffer()", ["text", "capacity"])
                continue
            elif v.type == "uint8_t" and v.pointer:
                take("s.marks()", ["data", "count"])
                continue
            elif v.type in self.structs:
                drawn = f"s.struct_in<{v.type}>()" if v.const else f"s.struct_out<{v.type}>()"
            elif v.type == "char":
                drawn = f"s.text(\"{v.name}\")"
            elif v.pointer and v.const and v.type == "float" and v.length:
                drawn = f"s.vector({v.length})"
            elif v.pointer and not v.const and (v.type in CELLS or v.type in self.ranges):
                drawn = f"s.cell<{v.type}>({v.length or ''})"
            elif v.type in self.ranges:
                low, high = self.ranges[v.type]
                drawn = f"s.an_enum({low}, {high})"
            elif v.type in CELLS:
                drawn = f"s.a<{v.type}>(\"{v.name}\")"
            else:
                raise SystemExit(f"{f.name}: {v.type} {v.name} is not understood")
            lines.append(f"const auto {name} = {drawn};")
            passed.append(name)
            i += 1
        return lines, passed, kept, made

    def call(self, f):
        lines, passed, kept, made = self.arguments(f)
        call = f"{f.name}({', '.join(passed)})"
        if f.result == "vfit_result":
            lines.append(f"const vfit_result result = {call};")
            lines += [f"s.keep({name}, result);" for name in kept]
            lines += [f"s.learn(\"{f.name}\", {name}, result);" for name in made]
            lines.append("return result;")
        else:
            lines += [f"(void){call};", "return VFIT_OK;"]
        body = "".join(f"        {line}\n" for line in lines)
        return f"    {{\"{f.name}\", [](Storm& s) -> vfit_result {{\n        (void)s;\n{body}    }}}},\n"

    def handles_text(self):
        return "#define VFIT_STORM_HANDLES(X) \\\n" + "".join(self.kinds()) + "\n"

    def calls_text(self):
        return (
            "".join(f"inline void fill(Storm&, {s.name}&);\n" for s in self.header.structs)
            + "".join(self.filling(s) for s in self.header.structs)
            + "inline const Call kCalls[] = {\n"
            + "".join(self.call(f) for f in self.header.functions)
            + "};\n"
        )


def main():
    header, folder = map(pathlib.Path, sys.argv[1:])
    writer = Writer(read_header(header.read_text()))
    folder.mkdir(parents=True, exist_ok=True)
    head = "// Written by tests/storm/make_calls.py from include/vfit.h.\n#pragma once\n"
    (folder / "handles.h").write_text(head + writer.handles_text())
    (folder / "calls.h").write_text(head + writer.calls_text())


main()
