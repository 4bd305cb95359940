#!/usr/bin/env python3
"""Mean stress of one elasto-plastic sphere in a cubic box that closes in on it, by implicit finite elements.

An independent reference for the solver: nothing here is shared with it, neither element nor contact nor integration
in time. By symmetry a 48th of the sphere stands for all of it: 0 <= z <= y <= x, pressed by the smooth plane x = L.

- Elements: hexahedra with 27 nodes and a linear, discontinuous pressure (Q2/P1, free of locking).
- Kinematics: finite strain, updated Lagrangian; strain and rotation of an increment from its midpoint
  (Hughes and Winget, 1980). Static equilibrium by Newton's method, for displacements of the plane in small steps.
- Material: deviatoric Cauchy stress by the rate 2 G dev d in the rotated frame, von Mises yield with
  sigma_y + k eps_p^m, radial return; pressure -K ln J, projected onto the linear functions of each element.
- Contact: penalty at the quadrature points of the surface; penetrations are of 1e-5 R.

Units: mm, N, MPa; R = 1. Needs NumPy and SciPy.
Usage: sphere_in_cube.py [SUBDIVISIONS] [LARGEST_STEP] > sphere_in_cube.csv
"""
import sys

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

E, NU, SIGMA_Y, HARDENING, EXPONENT = 5000.0, 0.3, 25.0, 125.0, 0.3  # Table 1 of Ku, Zhao, Mollon and Zhao
G, K = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
PENALTY = 1e7  # MPa / mm
SMALLEST_WALL = (np.pi / 6 / 0.97) ** (1 / 3)  # half length of the box at a relative density of 0.97


# ---------------------------------------------------------------------------------------------------- mesh
def position(barycentric):
    """Points (n, 3) of the wedge: radial near the surface, straight near the centre. Barycentric (n, 4): O, A, B, C."""
    corners = np.array([[1, 0, 0], [1, 1, 0] / np.sqrt(2), [1, 1, 1] / np.sqrt(3)])
    flat = barycentric[:, 1:] @ corners
    length = np.linalg.norm(flat, axis=1, keepdims=True)
    rho = 1 - barycentric[:, :1]
    sphere = rho * flat / np.where(length > 0, length, 1)
    return flat + rho**2 * (sphere - flat)


def wedge_mesh(n):
    """Nodes (N, 3), elements (M, 27), faces on the sphere (F, 9), barycentric coordinates (N, 4)."""
    identity = np.eye(4)
    index, barycentrics, elements, faces = {}, [], [], []

    def node(b):
        key = tuple(np.round(b * 5040 * n).astype(int))
        if key not in index:
            index[key] = len(barycentrics)
            barycentrics.append(b)
        return index[key]

    for v in range(4):
        others = [w for w in range(4) if w != v]
        if np.linalg.det(np.array([identity[w][1:] - identity[v][1:] for w in others])) < 0:
            others[1], others[2] = others[2], others[1]
        corner = np.zeros((2, 2, 2, 4))
        for i in range(2):
            for j in range(2):
                for k in range(2):
                    used = [v] + [w for w, on in zip(others, (i, j, k)) if on]
                    corner[i, j, k] = identity[used].mean(axis=0)

        def at(i, j, k):
            t = np.array([i, j, k]) / (2 * n)
            weights = [np.array([1 - s, s]) for s in t]
            return np.einsum("i,j,k,ijkb->b", *weights, corner)

        grid = np.array([[[node(at(i, j, k)) for k in range(2 * n + 1)] for j in range(2 * n + 1)]
                         for i in range(2 * n + 1)])
        for i in range(n):
            for j in range(n):
                for k in range(n):
                    elements.append(grid[2 * i:2 * i + 3, 2 * j:2 * j + 3, 2 * k:2 * k + 3].reshape(27))
        if v != 0:
            grid = np.moveaxis(grid, others.index(0), 0)[0]  # the face without a share of O
            for i in range(n):
                for j in range(n):
                    faces.append(grid[2 * i:2 * i + 3, 2 * j:2 * j + 3].reshape(9))
    barycentrics = np.array(barycentrics)
    return position(barycentrics), np.array(elements), np.array(faces), barycentrics


def constraints(barycentrics):
    """Matrix (3 N, free) from free displacements to all: z = 0, y = z and x = y are planes of symmetry."""
    rows, columns, free = [], [], 0
    on = np.abs(barycentrics) < 1e-9
    for a, (no_o, no_a, no_b, no_c) in enumerate(on):
        # A face misses one corner: z = 0 has no C, y = z no B, x = y no A.
        groups = [[0], [1], [2]]
        if no_a:
            groups = [[0, 1], [2]]
        if no_b:
            groups = [[0, 1, 2]] if no_a else [[0], [1, 2]]
        if no_c:
            groups = [g for g in groups if 2 not in g]
        for g in groups:
            for axis in g:
                rows.append(3 * a + axis)
                columns.append(free)
            free += 1
    return sparse.csr_matrix((np.ones(len(rows)), (rows, columns)), shape=(3 * len(barycentrics), free))


# ---------------------------------------------------------------------------------------------------- elements
def lagrange(x):
    """Values and derivatives (3,) of the quadratic polynomials at -1, 0, 1."""
    return (np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]), np.array([x - 0.5, -2 * x, x + 0.5]))


GAUSS = np.array([-np.sqrt(0.6), 0, np.sqrt(0.6)]), np.array([5, 8, 5]) / 9


def volume_shapes():
    """Derivatives (27 points, 27 nodes, 3), weights (27), functions of the pressure (27, 4)."""
    derivatives, weights, pressure = [], [], []
    for i in range(3):
        for j in range(3):
            for k in range(3):
                x = [GAUSS[0][i], GAUSS[0][j], GAUSS[0][k]]
                (a, da), (b, db), (c, dc) = (lagrange(s) for s in x)
                derivatives.append(np.stack([np.einsum("i,j,k->ijk", *f).ravel()
                                             for f in ((da, b, c), (a, db, c), (a, b, dc))], axis=1))
                weights.append(GAUSS[1][i] * GAUSS[1][j] * GAUSS[1][k])
                pressure.append([1.0, *x])
    return np.array(derivatives), np.array(weights), np.array(pressure)


def face_shapes(points=5):
    """Values (Q, 9), derivatives (Q, 9, 2) and weights (Q) on a face."""
    x, w = np.polynomial.legendre.leggauss(points)
    values, derivatives, weights = [], [], []
    for i in range(points):
        for j in range(points):
            (a, da), (b, db) = lagrange(x[i]), lagrange(x[j])
            values.append(np.outer(a, b).ravel())
            derivatives.append(np.stack([np.outer(da, b).ravel(), np.outer(a, db).ravel()], axis=1))
            weights.append(w[i] * w[j])
    return np.array(values), np.array(derivatives), np.array(weights)


SHAPE, WEIGHT, PRESSURE = volume_shapes()
FACE, FACE_DERIVATIVE, FACE_WEIGHT = face_shapes()
IDENTITY = np.eye(3)
SYMMETRIC = 0.5 * (np.einsum("ik,jl->ijkl", IDENTITY, IDENTITY) + np.einsum("il,jk->ijkl", IDENTITY, IDENTITY))
DEVIATORIC = SYMMETRIC - np.einsum("ij,kl->ijkl", IDENTITY, IDENTITY) / 3


def gradients(x):
    """Derivatives (M, 27, 27, 3) of the shape functions by position and volumes (M, 27) of the points."""
    jacobian = np.einsum("eai,qak->eqik", x, SHAPE)
    return np.einsum("qak,eqki->eqai", SHAPE, np.linalg.inv(jacobian)), np.linalg.det(jacobian) * WEIGHT


def plastic_increment(trial, plastic):
    """Increment of plastic strain for which the reduced trial stress meets the flow stress; bisection and Newton."""
    low, high = np.zeros_like(trial), np.maximum(trial - SIGMA_Y, 0) / (3 * G)
    step = 0.5 * high
    for _ in range(60):
        strain = plastic + step
        flow = SIGMA_Y + HARDENING * strain**EXPONENT
        excess = trial - 3 * G * step - flow
        low, high = np.where(excess > 0, step, low), np.where(excess > 0, high, step)
        slope = 3 * G + HARDENING * EXPONENT * np.maximum(strain, 1e-300) ** (EXPONENT - 1)
        newton = step + excess / slope
        step = np.where((newton > low) & (newton < high), newton, 0.5 * (low + high))
    return step


class Sphere:
    """The wedge with its state at the last converged step."""

    def __init__(self, n):
        self.x0, self.elements, self.faces, barycentrics = wedge_mesh(n)
        self.free = constraints(barycentrics)
        _, self.volume0 = gradients(self.x0[self.elements])
        assert self.volume0.min() > 0
        mass = np.einsum("eq,qs,qt->est", self.volume0, PRESSURE, PRESSURE)
        self.project = np.einsum("est,eq,qt->esq", np.linalg.inv(mass), self.volume0, PRESSURE)
        shape = self.volume0.shape
        self.stress, self.plastic = np.zeros((*shape, 3, 3)), np.zeros(shape)
        self.x = self.x0.copy()
        dofs = (3 * self.elements[:, :, None] + np.arange(3)).reshape(len(self.elements), 81)
        self.rows, self.columns = np.repeat(dofs, 81, axis=1).ravel(), np.tile(dofs, (1, 81)).ravel()
        self.dofs = dofs
        self.face_dofs = 3 * self.faces  # only x matters

    def update(self, x):
        """Deviatoric stress, plastic strain and tangent dev(d stress)/d l at the points for new positions."""
        mid = 0.5 * (x + self.x)
        b_mid, _ = gradients(mid[self.elements])
        gradient = np.einsum("eai,eqaj->eqij", (x - self.x)[self.elements], b_mid)
        d = 0.5 * (gradient + np.swapaxes(gradient, 2, 3))
        w = 0.5 * (gradient - np.swapaxes(gradient, 2, 3))
        rotation = np.linalg.solve(IDENTITY - 0.5 * w, IDENTITY + 0.5 * w)
        d = d - np.trace(d, axis1=2, axis2=3)[..., None, None] / 3 * IDENTITY
        trial = rotation @ self.stress @ np.swapaxes(rotation, 2, 3) + 2 * G * d
        q = np.sqrt(1.5 * np.einsum("eqij,eqij->eq", trial, trial))
        yields = q > SIGMA_Y + HARDENING * self.plastic**EXPONENT
        step = np.where(yields, plastic_increment(q, self.plastic), 0)
        plastic = self.plastic + step
        safe = np.where(q > 0, q, 1)
        scale = 1 - 3 * G * step / safe
        stress = scale[..., None, None] * trial
        slope = HARDENING * EXPONENT * np.maximum(plastic, 1e-12) ** (EXPONENT - 1)
        normal = trial / safe[..., None, None]
        along = np.where(yields, 3 * G * (1 / (1 + slope / (3 * G)) - 3 * G * step / safe), 0)
        tangent = 2 * G * scale[..., None, None, None, None] * DEVIATORIC
        tangent = tangent - along[..., None, None, None, None] * np.einsum("eqij,eqkl->eqijkl", normal, normal)
        return stress, plastic, tangent

    def inner(self, x):
        """Forces (3 N) and their derivative of the elements, with the new state."""
        b, volume = gradients(x[self.elements])
        stress, plastic, tangent = self.update(x)
        log_j = np.log(volume / self.volume0)
        pressure = -K * np.einsum("qs,esp,ep->eq", PRESSURE, self.project, log_j)
        total = stress - pressure[..., None, None] * IDENTITY
        force = np.einsum("eqij,eqaj,eq->eai", total, b, volume)
        # Change of the stress with the velocity gradient l: return map, spin, convection.
        s = stress
        spin = 0.5 * (np.einsum("ik,eqlj->eqijkl", IDENTITY, s) - np.einsum("il,eqkj->eqijkl", IDENTITY, s)
                      - np.einsum("jl,eqik->eqijkl", IDENTITY, s) + np.einsum("jk,eqil->eqijkl", IDENTITY, s))
        a = tangent + spin + np.einsum("eqij,kl->eqijkl", total, IDENTITY)
        a = a - np.einsum("eqil,jk->eqijkl", total, IDENTITY)
        count = len(self.elements)
        operator = np.zeros((count, 27, 9, 81))
        for i in range(3):
            for j in range(3):
                operator[:, :, 3 * i + j, i::3] = b[..., j]
        weighted = (a * volume[..., None, None, None, None]).reshape(count, 27, 9, 9)
        matrix = np.swapaxes(operator.reshape(count, 243, 81), 1, 2) @ (weighted @ operator).reshape(count, 243, 81)
        divergence = operator[:, :, 0] + operator[:, :, 4] + operator[:, :, 8]
        modes = np.einsum("eqr,eq,qs->ers", divergence, volume, PRESSURE)
        matrix += K * modes @ np.einsum("esq,eqn->esn", self.project, divergence)
        f = np.bincount(self.dofs.ravel(), force.reshape(-1), minlength=3 * len(x))
        return f, (matrix.ravel(), self.rows, self.columns), stress, plastic

    def contact(self, x, wall):
        """Forces of the plane x = wall on the nodes, their derivative, N on the plane, mm^2 of contact."""
        p = x[self.faces]
        t = np.einsum("fai,qad->fqdi", p, FACE_DERIVATIVE)
        area = np.abs(t[:, :, 0, 1] * t[:, :, 1, 2] - t[:, :, 0, 2] * t[:, :, 1, 1]) * FACE_WEIGHT  # projected onto x
        depth = np.einsum("fa,qa->fq", p[:, :, 0], FACE) - wall
        pressed = PENALTY * np.maximum(depth, 0) * area
        force = np.zeros((len(x), 3))
        np.add.at(force[:, 0], self.faces, np.einsum("fq,qa->fa", pressed, FACE))
        matrix = np.einsum("fq,qa,qb->fab", PENALTY * (depth > 0) * area, FACE, FACE)
        rows = np.repeat(self.face_dofs, 9, axis=1).ravel()
        columns = np.tile(self.face_dofs, (1, 9)).ravel()
        return force.ravel(), (matrix.ravel(), rows, columns), pressed.sum(), (area * (depth > 0)).sum()

    def press(self, wall, guess):
        """Equilibrium against the plane: its force and area on the wedge, and the iterations; None where none is found."""
        x, size = guess.copy(), 3 * len(self.x0)
        for iteration in range(16):
            if gradients(x[self.elements])[1].min() <= 0:
                return None
            f, inner, stress, plastic = self.inner(x)
            push, outer, normal, area = self.contact(x, wall)
            residual = self.free.T @ (f + push)
            scale = max(np.abs(self.free.T @ push).max(), 1e-6)
            if iteration > 0 and np.abs(residual).max() < 1e-6 * scale:
                self.x, self.stress, self.plastic = x, stress, plastic
                return normal, area, iteration
            values, rows, columns = (np.concatenate(parts) for parts in zip(inner, outer))
            matrix = sparse.csc_matrix((values, (rows, columns)), shape=(size, size))
            solver = splu((self.free.T @ matrix @ self.free).tocsc(), permc_spec="MMD_AT_PLUS_A")
            step = self.free @ solver.solve(-residual)
            x = x + min(1, 0.02 / np.abs(step).max()) * step.reshape(-1, 3)
        return None


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 4
    largest_step = float(sys.argv[2]) if len(sys.argv) > 2 else 0.002
    sphere = Sphere(n)
    print(f"# One sphere in a closing cubic box: sphere_in_cube.py {n} {largest_step:g}, {len(sphere.elements)} elements")
    print("# Table 1 of Ku, Zhao, Mollon and Zhao: E = 5000 MPa, nu = 0.3, 25 + 125 eps_p^0.3 MPa")
    print("relative_density,mean_stress_MPa,contact_area_over_wall,largest_plastic_strain")
    # Steps follow the iterations: contact begins at a point, and elements join it one after the other.
    wall, step, rate = 1.0, 0.0005, np.zeros_like(sphere.x0)
    while wall > SMALLEST_WALL:
        before = sphere.x
        found = sphere.press(wall - step, before + step * rate)
        found = found or sphere.press(wall - step, before)
        if found is None:
            step /= 2
            if step < 1e-6:
                sys.exit(f"no equilibrium below a wall of {wall}")
            continue
        wall -= step
        rate = (sphere.x - before) / step
        force, area, iterations = found
        density, side = np.pi / 6 / wall**3, (2 * wall) ** 2
        print(f"{density:.6f},{8 * force / side:.6f},{8 * area / side:.6f},{sphere.plastic.max():.4f}", flush=True)
        print(f"wall {wall:.5f} D_r {density:.4f} p {8 * force / side:.3f} iterations {iterations}", file=sys.stderr)
        if iterations <= 5:
            step = min(1.4 * step, largest_step)


if __name__ == "__main__":
    main()
