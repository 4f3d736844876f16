#!/usr/bin/env python3
"""Tetrahedra of a bar 1 x 0.1 x 0.1, strongly graded, in Gmsh's format 2.2.

mesh.py OUT            OUT/bar_1.msh and OUT/bar_2.msh: bar.msh beside this script, each tetrahedron split in 8, and again;
mesh.py --new FILE     a new mesh as FILE: Delaunay's of random points of a fixed seed, some in tight clusters
                       (needs scipy); bar.msh was made so
"""
import sys
from pathlib import Path

import numpy as np

SIZE = np.array([1.0, 0.1, 0.1])
INSIDE, ON_FACES, SEED = 110, 100, 2013
# Corners of the 8 children: 0..3 the parent's, 4..9 the middles of its edges (01, 02, 03, 12, 13, 23). The four at the
# corners, then the octahedron between them about its diagonal 02-13 (6-8 below is 03-13, 5-8 is 02-13).
EDGES = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
CORNERS = ((0, 4, 5, 6), (1, 4, 7, 8), (2, 5, 7, 9), (3, 6, 8, 9))
DIAGONALS = {(5, 8): ((5, 8, 4, 6), (5, 8, 6, 9), (5, 8, 9, 7), (5, 8, 7, 4)),
             (4, 9): ((4, 9, 5, 6), (4, 9, 6, 8), (4, 9, 8, 7), (4, 9, 7, 5)),
             (6, 7): ((6, 7, 4, 5), (6, 7, 5, 9), (6, 7, 9, 8), (6, 7, 8, 4))}


def signed_volumes(nodes, tetrahedra):
    a, b, c, d = (nodes[tetrahedra[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0


def volumes(nodes, tetrahedra):
    return np.abs(signed_volumes(nodes, tetrahedra))


def oriented(nodes, tetrahedra):
    """The same with positive volumes: the last two corners of an inverted one change places."""
    inverted = signed_volumes(nodes, tetrahedra) < 0.0
    tetrahedra = tetrahedra.copy()
    tetrahedra[inverted] = tetrahedra[inverted][:, [0, 1, 3, 2]]
    return tetrahedra


def read(file):
    lines = Path(file).read_text().split("\n")
    start = lines.index("$Nodes")
    count = int(lines[start + 1])
    nodes = np.array([[float(w) for w in line.split()[1:]] for line in lines[start + 2:start + 2 + count]])
    start = lines.index("$Elements")
    count = int(lines[start + 1])
    tetrahedra = np.array([[int(w) - 1 for w in line.split()[-4:]] for line in lines[start + 2:start + 2 + count]])
    return nodes, tetrahedra


def write(file, nodes, tetrahedra):
    tetrahedra = oriented(nodes, tetrahedra)
    with open(file, "w", newline="\n") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        out.write(f"$Nodes\n{len(nodes)}\n")
        out.writelines(f"{i} {x:.9g} {y:.9g} {z:.9g}\n" for i, (x, y, z) in enumerate(nodes, start=1))
        out.write(f"$EndNodes\n$Elements\n{len(tetrahedra)}\n")
        out.writelines(f"{i} 4 2 1 1 {a} {b} {c} {d}\n" for i, (a, b, c, d) in enumerate(tetrahedra + 1, start=1))
        out.write("$EndElements\n")


def split(nodes, tetrahedra):
    """Each tetrahedron as 8 of an eighth of its volume; the octahedron in its middle is cut along its shortest diagonal."""
    middle, points = {}, [tuple(p) for p in nodes]

    def middle_of(a, b):
        key = (min(a, b), max(a, b))
        if key not in middle:
            middle[key] = len(points)
            points.append(tuple(0.5 * (nodes[a] + nodes[b])))
        return middle[key]

    children = []
    for parent in tetrahedra:
        ten = list(parent) + [middle_of(parent[a], parent[b]) for a, b in EDGES]
        shortest = min(DIAGONALS, key=lambda pair: np.linalg.norm(np.subtract(points[ten[pair[0]]], points[ten[pair[1]]])))
        children += [[ten[i] for i in child] for child in CORNERS + DIAGONALS[shortest]]
    return np.array(points), np.array(children)


def new_mesh():
    from scipy.spatial import Delaunay

    random = np.random.default_rng(SEED)
    inside = random.random((INSIDE, 3))
    faces = random.random((ON_FACES, 3))
    axis = random.choice(3, ON_FACES, p=[0.04, 0.48, 0.48])
    faces[np.arange(ON_FACES), axis] = random.integers(0, 2, ON_FACES)
    edges = np.array([[x, y, z] for x in np.linspace(0.0, 1.0, 12) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    points = np.vstack([inside, faces, edges]) * SIZE
    # Every eighth inner point becomes a cluster of four, 1/20 to 1/2 of the spacing wide.
    spacing = (SIZE.prod() / INSIDE) ** (1 / 3)
    near = np.repeat(inside[::8] * SIZE, 3, axis=0)
    width = np.repeat(0.05 * 10.0 ** random.random(len(inside[::8])), 3)
    direction = random.normal(size=near.shape)
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    companions = near + direction * (spacing * width)[:, None]
    points = np.vstack([points, np.clip(companions, 0.0, SIZE)])
    tetrahedra = Delaunay(points).simplices
    volume = volumes(points, tetrahedra)
    return points, tetrahedra[volume > 1e-7 * volume.max()]


def describe(name, nodes, tetrahedra):
    volume = volumes(nodes, tetrahedra)
    print(f"{name}: {len(tetrahedra)} tetrahedra, volume {volume.sum():.12f}, radii 1 : "
          f"{(volume.max() / volume.min()) ** (1 / 3):.1f}")


def main(words):
    if len(words) == 2 and words[0] == "--new":
        nodes, tetrahedra = new_mesh()
        write(words[1], nodes, tetrahedra)
        describe(words[1], nodes, tetrahedra)
        return
    if len(words) != 1:
        sys.exit(__doc__)
    nodes, tetrahedra = read(Path(__file__).parent / "bar.msh")
    out = Path(words[0])
    describe("bar.msh", nodes, tetrahedra)
    for level in (1, 2):
        nodes, tetrahedra = split(nodes, tetrahedra)
        write(out / f"bar_{level}.msh", nodes, tetrahedra)
        describe(f"bar_{level}.msh", nodes, tetrahedra)


if __name__ == "__main__":
    main(sys.argv[1:])
