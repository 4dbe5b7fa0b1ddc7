# SPDX-License-Identifier: MIT
"""What is worth having of many, by two measures of which less is better."""
import math


def undominated(points):
    """Of points with x and y those that no other is better than in both, by rising x."""
    best, kept = math.inf, []
    for p in sorted(points, key=lambda p: (p.x, p.y)):
        if p.y < best:
            best = p.y
            kept.append(p)
    return kept
