# SPDX-License-Identifier: MIT
"""Reads the OpenEXR files that Lodestir writes: one part of scan lines, ZIP or uncompressed, half or single floats.

The form is that of "OpenEXR File Layout" (openexr.com): magic number, version, attributes, offsets of blocks, blocks of scan lines.
"""
import struct
import zlib

import numpy

SAMPLES = {1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES = {0: 1, 2: 1, 3: 16}  # of a block, by compression: none, ZIPS, ZIP


def text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def attributes(data):
    """Of the header, by name, and where it ends."""
    found, at = {}, 8
    while data[at] != 0:
        name, at = text(data, at)
        _, at = text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channels(data):
    """(name, type of samples) in the file's order, which is that of names."""
    found, at = [], 0
    while data[at] != 0:
        name, at = text(data, at)
        found.append((name, SAMPLES[struct.unpack_from("<i", data, at)[0]]))
        at += 16
    return found


def inflate(block, size):
    """Undoes ZIP: differences of bytes, of which the first half are those at even places."""
    if len(block) == size:
        return block  # what would have grown is stored as it is
    steps = numpy.frombuffer(zlib.decompress(block), numpy.uint8).astype(numpy.int64)
    steps[1:] -= 128
    sums = numpy.cumsum(steps).astype(numpy.uint8)
    whole = numpy.empty_like(sums)
    half = (len(sums) + 1) // 2
    whole[0::2], whole[1::2] = sums[:half], sums[half:]
    return whole.tobytes()


def read(path):
    """(height, width, 3) array of 32-bit floats: R, G and B."""
    try:
        return parse(path.read_bytes(), path)
    except (struct.error, IndexError, KeyError, zlib.error) as error:
        raise ValueError(f"{path}: is damaged or cut: {error}") from None


def parse(data, path):
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError(f"{path}: is no OpenEXR file")
    header, at = attributes(data)
    compression = header["compression"][0]
    if compression not in LINES:
        raise ValueError(f"{path}: has a compression that Lodestir does not write")
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    layout = channels(header["channels"])
    image = {name: numpy.empty((height, width), numpy.float32) for name, _ in layout}
    line_size = sum(kind.itemsize for _, kind in layout) * width
    for (place,) in struct.iter_unpack("<Q", data[at:at + 8 * -(-height // LINES[compression])]):
        first, size = struct.unpack_from("<ii", data, place)
        first -= top
        count = min(LINES[compression], height - first)
        block = inflate(data[place + 8:place + 8 + size], count * line_size)
        offset = 0
        for line in range(first, first + count):
            for name, kind in layout:
                image[name][line] = numpy.frombuffer(block, kind, width, offset)
                offset += kind.itemsize * width
    grey = image.get("Y")
    return numpy.stack([image.get(name, grey) for name in "RGB"], axis=-1)
