#!/usr/bin/env python3
"""Moves overlapping spheres apart in a box: the grains of a DEM code that lets them overlap.

    relax_spheres.py spheres.csv X Y Z GAP > apart.csv

spheres.csv: x,y,z,radius in mm, lines with # are comments. X, Y, Z: the box, mm, from the origin; z is stretched to
it first. Surfaces end up at least GAP apart, and GAP/2 from walls, or the script fails. Least-squares overlaps by L-BFGS; needs scipy.
"""
import sys

import numpy as np
from scipy.optimize import minimize
from scipy.spatial import cKDTree


def overlap_energy(flat, reach, box):
    """Half the sum of squared overlaps of spheres of radius `reach` with each other and with walls, mm^2, and its
    gradient with respect to the centres."""
    x = flat.reshape(-1, 3)
    gradient = np.zeros_like(x)
    a, b = cKDTree(x).query_pairs(2 * reach.max(), output_type="ndarray").T
    way = x[a] - x[b]
    distance = np.linalg.norm(way, axis=1)
    depth = np.maximum(reach[a] + reach[b] - distance, 0)
    push = (depth / distance)[:, None] * way
    np.add.at(gradient, a, -push)
    np.add.at(gradient, b, push)
    low = np.maximum(reach[:, None] - x, 0)
    high = np.maximum(x + reach[:, None] - box, 0)
    gradient += high - low
    return 0.5 * (depth @ depth + (low**2).sum() + (high**2).sum()), gradient.ravel()


def relax(x, radius, box, gap):
    """Centres, mm, of the spheres in the box when all are `gap` apart."""
    reach = radius + 0.52 * gap
    x = x * np.array([1, 1, box[2] / (x[:, 2] + radius).max()])
    found = minimize(overlap_energy, x.ravel(), (reach, box), jac=True, method="L-BFGS-B",
                     options={"maxiter": 100000, "maxfun": 200000, "gtol": 1e-12, "ftol": 1e-30})
    return found.x.reshape(-1, 3)


def smallest_gap(x, radius, box):
    """Between surfaces of any two spheres, or twice that of one and a wall, mm."""
    pairs = cKDTree(x).query_pairs(2.5 * radius.max(), output_type="ndarray")
    between = np.linalg.norm(x[pairs[:, 0]] - x[pairs[:, 1]], axis=1) - radius[pairs].sum(axis=1)
    return min(between.min(), 2 * (x - radius[:, None]).min(), 2 * (box - x - radius[:, None]).min())


def main():
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    with open(sys.argv[1], encoding="utf-8") as file:
        rows = [line.split(",") for line in file if line[0] not in "#x"]
    table = np.array(rows, dtype=float)
    box, gap = np.array(sys.argv[2:5], dtype=float), float(sys.argv[5])
    x = relax(table[:, :3], table[:, 3], box, gap)
    if smallest_gap(x, table[:, 3], box) < gap:
        sys.exit(f"relax_spheres.py: error: gap {smallest_gap(x, table[:, 3], box):.3g} mm, wanted {gap:g}")
    print("x,y,z,radius")
    for centre, radius in zip(x, table[:, 3]):
        print(*(f"{value:.7g}" for value in (*centre, radius)), sep=",")


if __name__ == "__main__":
    main()
