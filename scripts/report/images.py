# SPDX-License-Identifier: MIT
"""Images for viewer.js: half floats, packed into text."""
import base64
import zlib

import numpy
from matplotlib import colormaps

ERRORS = (-3, 1)  # decades that the error map's colours span


def packed(image):
    """Red, green, blue of each pixel as half floats: all high bytes, then all low ones, deflated, in base64."""
    with numpy.errstate(over="ignore"):
        halves = numpy.clip(image, -65504, 65504).astype("<f2")
    raw = numpy.ascontiguousarray(halves).view(numpy.uint8).reshape(-1, 2)
    return base64.b64encode(zlib.compress(raw[:, 1].tobytes() + raw[:, 0].tobytes(), 6)).decode()


def embedded(r, limit):
    """What viewer.js reads, and the names of what was left out to stay under `limit` bytes; nothing where no image was kept."""
    scenes, left_out, size = [], [], 0
    for s, name in enumerate(r.scenes):
        reference = r.reference(s)
        found = [("reference", reference)] + [(configuration.label, r.image(s, c)) for c, configuration in enumerate(r.configurations)]
        images = []
        for label, image in found:
            data = packed(image) if image is not None else None
            if data and size + len(data) > limit:
                left_out.append(f"{label} in {name}")
                data = None
            size += len(data or "")
            if data or label == "reference":  # the reference keeps its place
                images.append({"name": label, "data": data})
        if len(images) > 1:
            height, width, _ = next(image for label, image in found[1:] if image is not None).shape
            scenes.append({"name": name, "width": width, "height": height, "exposure": r.exposure(s), "images": images})
    if not scenes:
        return None, left_out
    colors = (numpy.array(colormaps["magma"](numpy.linspace(0, 1, 256)))[:, :3] * 255).round().astype(numpy.uint8)
    return {"scenes": scenes, "colors": base64.b64encode(colors.tobytes()).decode(), "errors": ERRORS}, left_out
