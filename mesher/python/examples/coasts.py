"""A mesh of what the coasts in a GeoJSON file enclose, finer towards the coast.

    coasts.py FILE.geojson [OUTPUT.vtu]
"""
import json
import sys

import numpy as np

import livemesh as lm


def coast_distance(points, at):
    """The distance of each position from the nearest of the points, some at a time."""
    return np.concatenate([np.sqrt(((part[:, None] - points) ** 2).sum(2).min(1))
                           for part in np.array_split(at, len(at) // 256 + 1)])


def mesh_of(path):
    with open(path, encoding="utf-8") as file:
        coasts = json.load(file)  # or geopandas.read_file(path): anything with a __geo_interface__
    graph = lm.Graph.read(path)
    every = graph.points[::max(1, len(graph.points) // 500)]
    width = np.ptp(graph.points, axis=0).max()
    size = lm.Sizes.sampled(lambda at: width / 100 + .2 * coast_distance(every, at),
                            graph.points.min(0), graph.points.max(0), tolerance=.2)
    return lm.mesh(coasts, min_angle=25, size=size)


if __name__ == "__main__":
    m = mesh_of(sys.argv[1])
    print(m, f"smallest angle in the median {np.median(m.quality('min_angle')):.1f} degrees")
    if len(sys.argv) > 2:
        m.write(sys.argv[2])
