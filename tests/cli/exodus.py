# SPDX-License-Identifier: BSD-3-Clause
"""Reads the variables of an Exodus file that is classic NetCDF with 64-bit offsets (CDF-2)."""
import math
import struct

SIZES = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}  # of byte, char, short, int, float, double


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, kind=">i"):
        value = struct.unpack_from(kind, self.data, self.at)[0]
        self.at += struct.calcsize(kind)
        return value

    def padded(self, size):
        value = self.data[self.at:self.at + size]
        self.at += (size + 3) // 4 * 4
        return value

    def name(self):
        return self.padded(self.number()).decode()

    def count(self):
        self.number()  # tag
        return self.number()

    def attributes(self):
        for _ in range(self.count()):
            self.name()
            kind, length = self.number(), self.number()
            self.padded(SIZES[kind] * length)


def variables(path):
    """Name -> bytes of the whole variable, steps one after the other."""
    reader = Reader(path.read_bytes())
    assert reader.padded(4) == b"CDF\x02"
    records = reader.number()
    lengths = []
    for _ in range(reader.count()):
        reader.name()
        lengths.append(reader.number())
    reader.attributes()
    found = []
    for _ in range(reader.count()):
        name = reader.name()
        dimensions = [reader.number() for _ in range(reader.number())]
        reader.attributes()
        kind, _, begin = reader.number(), reader.number(), reader.number(">q")
        per_record = bool(dimensions) and lengths[dimensions[0]] == 0
        size = SIZES[kind] * math.prod(lengths[d] for d in dimensions[per_record:])
        found.append((name, per_record, size, begin))
    stride = sum((size + 3) // 4 * 4 for _, per_record, size, _ in found if per_record)
    return {name: b"".join(reader.data[begin + k * stride:begin + k * stride + size]
                           for k in range(records if per_record else 1))
            for name, per_record, size, begin in found}


def doubles(values):
    return struct.unpack(f">{len(values) // 8}d", values)


def nodal(path, name, step):
    """Values of the nodal variable of that name at a step, from 1."""
    found = variables(path)
    length = len(found["coordx"])
    names = found["name_nod_var"]
    width = len(names) // sum(key.startswith("vals_nod_var") for key in found)
    listed = [names[k:k + width].split(b"\0")[0].decode() for k in range(0, len(names), width)]
    values = found[f"vals_nod_var{listed.index(name) + 1}"]
    return doubles(values[(step - 1) * length:step * length])
