#!/usr/bin/python3
"""Stress intensity factors of the semicircular bending specimen by linear-elastic finite elements.

Writes into data/reference (or the folder given with --out)
  scb_stress_intensity.json  Y_I, Y_II over the angle of the notch, which scenes read ("toughness")
  scb_lefm.csv               the load at which linear fracture mechanics expects the crack to start
With --check it writes nothing, but prints known results, other meshes and other domains of integration.

Method: six-node triangles, quarter-point nodes at the tip, point loads, interaction integral over a disc around the
tip. The factors do not depend on the elastic constants: the body is simply connected and its loads are given.

Conventions: K = P / (2 r t) sqrt(pi a) Y with the load P, radius r, thickness t, notch length a; Y_II > 0 for a notch
that leans to either side of the vertical; Y_I < 0 where the notch closes. Debian packages: python3-gmsh
python3-numpy python3-scipy.
"""
import argparse
import json
import pathlib

import gmsh
import numpy as np
import scipy.sparse
import scipy.sparse.linalg

E, NU = 1.0, 0.25  # plane strain
MU, KAPPA = E / (2 * (1 + NU)), 3 - 4 * NU
D = E / ((1 + NU) * (1 - 2 * NU)) * np.array([[1 - NU, NU, 0], [NU, 1 - NU, 0], [0, 0, 0.5 - NU]])

# Specimen and material of section 5.2 and Table 1 of Wang et al. (2020), doi 10.1002/nag.3069.
RADIUS, NOTCH, HALF_SPAN, THICKNESS = 47.5e-3, 16.6e-3, 23.75e-3, 20e-3  # m
K_IC = 2.15e6 * np.sqrt(1e-3)  # Pa sqrt(m), from 2.15 MPa sqrt(mm)

# Gauss points of the triangle, exact to degree 5: barycentric coordinates and weights.
A1, A2 = (6 - 15**0.5) / 21, (6 + 15**0.5) / 21
POINTS = np.array([[1 / 3, 1 / 3]] + [[a, b] for c in (A1, A2) for a, b in ((c, c), (1 - 2 * c, c), (c, 1 - 2 * c))])
WEIGHTS = np.array([9 / 80] + 3 * [(155 - 15**0.5) / 2400] + 3 * [(155 + 15**0.5) / 2400])


def mesh(corners, arcs, mouth, tip, finest, coarsest):
    """Nodes (n, 2) and triangles (m, 6) of a body with a crack from corner `mouth` to the point `tip`.

    corners: points in order; the edge after corner k is an arc around the origin when k is in `arcs`.
    """
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    geo = gmsh.model.geo
    points = [geo.addPoint(x, y, 0) for x, y in corners]
    centre = geo.addPoint(0, 0, 0) if arcs else 0
    edges = []
    for k, a in enumerate(points):
        b = points[(k + 1) % len(points)]
        edges.append(geo.addCircleArc(a, centre, b) if k in arcs else geo.addLine(a, b))
    end = geo.addPoint(*tip, 0)
    crack = geo.addLine(points[mouth], end)
    surface = geo.addPlaneSurface([geo.addCurveLoop(edges)])
    geo.synchronize()
    gmsh.model.mesh.embed(1, [crack], 2, surface)
    gmsh.model.addPhysicalGroup(2, [surface], 1)
    gmsh.model.addPhysicalGroup(1, [crack], 2)
    gmsh.model.addPhysicalGroup(0, [points[mouth]], 3)
    field = gmsh.model.mesh.field
    field.add("MathEval", 1)
    distance = f"Sqrt((x-({tip[0]}))^2+(y-({tip[1]}))^2)"
    field.setString(1, "F", f"Min({coarsest},{finest}+0.2*{distance})")
    field.setAsBackgroundMesh(1)
    for name in ("MeshSizeFromPoints", "MeshSizeExtendFromBoundary"):
        gmsh.option.setNumber(f"Mesh.{name}", 0)
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    for name, value in (("Dimension", 1), ("PhysicalGroup", 2), ("OpenBoundaryPhysicalGroup", 3)):
        gmsh.plugin.setNumber("Crack", name, value)
    gmsh.plugin.run("Crack")
    tags, xyz, _ = gmsh.model.mesh.getNodes()
    _, connectivity = gmsh.model.mesh.getElementsByType(9)
    gmsh.finalize()
    used = np.unique(connectivity)
    at = {t: k for k, t in enumerate(tags)}
    nodes = xyz.reshape(-1, 3)[[at[t] for t in used], :2]
    return nodes, np.searchsorted(used, connectivity).reshape(-1, 6)


def quarter_points(nodes, triangles, tip):
    """Moves the middle nodes next to the tip, so that the strain has its singularity there."""
    nodes = nodes.copy()
    at_tip = np.linalg.norm(nodes - tip, axis=1) < 1e-9 * np.ptp(nodes)
    for t in triangles[at_tip[triangles[:, :3]].any(axis=1)]:
        for middle, (a, b) in zip(t[3:], ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))):
            if at_tip[b]:
                a, b = b, a
            if at_tip[a]:
                nodes[middle] = 0.75 * nodes[a] + 0.25 * nodes[b]
    return nodes


def shape(point):
    """Shape functions (6) of the triangle and their derivatives (6, 2) in its own coordinates."""
    s, t = point
    r = 1 - s - t
    n = np.array([r * (2 * r - 1), s * (2 * s - 1), t * (2 * t - 1), 4 * r * s, 4 * s * t, 4 * t * r])
    d = np.array([[1 - 4 * r, 1 - 4 * r], [4 * s - 1, 0], [0, 4 * t - 1],
                  [4 * (r - s), -4 * s], [4 * t, 4 * s], [-4 * t, 4 * (r - t)]])
    return n, d


def gradients(x, d):
    """Derivatives (m, 6, 2) of the shape functions in space, and determinants (m)."""
    jacobian = np.einsum("mni,nj->mij", x, d)
    return np.einsum("nj,mji->mni", d, np.linalg.inv(jacobian)), np.linalg.det(jacobian)


def displacements(nodes, triangles, forces, held):
    """Displacements (n, 2) under nodal forces (n, 2); held: list of (node, component)."""
    x = nodes[triangles]
    k = np.zeros((len(triangles), 12, 12))
    for point, weight in zip(POINTS, WEIGHTS):
        g, det = gradients(x, shape(point)[1])
        b = np.zeros((len(triangles), 3, 12))
        b[:, 0, 0::2], b[:, 1, 1::2] = g[:, :, 0], g[:, :, 1]
        b[:, 2, 0::2], b[:, 2, 1::2] = g[:, :, 1], g[:, :, 0]
        k += np.einsum("mai,ab,mbj,m->mij", b, D, b, weight * det, optimize=True)
    dofs = np.stack([2 * triangles, 2 * triangles + 1], axis=2).reshape(-1, 12)
    rows, columns = np.repeat(dofs, 12, axis=1).ravel(), np.tile(dofs, (1, 12)).ravel()
    matrix = scipy.sparse.csr_matrix((k.ravel(), (rows, columns)))
    free = np.setdiff1d(np.arange(2 * len(nodes)), [2 * n + c for n, c in held])
    u = np.zeros(2 * len(nodes))
    u[free] = scipy.sparse.linalg.spsolve(matrix[free][:, free].tocsc(), forces.ravel()[free])
    return u.reshape(-1, 2)


def tip_field(mode, r, theta):
    """Displacement gradient (m, 2, 2) of the field at a crack tip with K = 1; the crack is at theta = +-pi."""
    c, s = np.cos(theta / 2), np.sin(theta / 2)
    ct, st = np.cos(theta), np.sin(theta)
    if mode == 1:
        f = np.stack([c * (KAPPA - ct), s * (KAPPA - ct)], axis=1)
        df = np.stack([-s / 2 * (KAPPA - ct) + c * st, c / 2 * (KAPPA - ct) + s * st], axis=1)
    else:
        f = np.stack([s * (KAPPA + 2 + ct), -c * (KAPPA - 2 + ct)], axis=1)
        df = np.stack([c / 2 * (KAPPA + 2 + ct) - s * st, s / 2 * (KAPPA - 2 + ct) + c * st], axis=1)
    factor = (1 / (2 * MU * np.sqrt(2 * np.pi * r)))[:, None]
    along, around = factor * f / 2, factor * df  # d/dr and d/(r dtheta)
    return np.stack([along * ct[:, None] - around * st[:, None], along * st[:, None] + around * ct[:, None]], axis=2)


def stress(gradient):
    """Stress (m, 2, 2) of displacement gradients."""
    strain = np.stack([gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], axis=1)
    s = strain @ D
    return np.stack([np.stack([s[:, 0], s[:, 2]], axis=1), np.stack([s[:, 2], s[:, 1]], axis=1)], axis=1)


def stress_intensity(nodes, triangles, u, tip, direction, radius):
    """K_I, K_II by the interaction integral over the elements at about `radius` from the tip."""
    rotation = np.array([direction, [-direction[1], direction[0]]])  # rows: axes along and across the crack
    local = (nodes - tip) @ rotation.T
    moved = u @ rotation.T
    q = (np.linalg.norm(local, axis=1) < radius).astype(float)
    chosen = np.ptp(q[triangles], axis=1) > 0
    t = triangles[chosen]
    k = np.zeros(2)
    for point, weight in zip(POINTS, WEIGHTS):
        n, d = shape(point)
        g, det = gradients(local[t], d)
        x = np.einsum("n,mni->mi", n, local[t])
        grad_u = np.einsum("mni,mnj->mij", moved[t], g)
        grad_q = np.einsum("mn,mnj->mj", q[t], g)
        sigma = stress(grad_u)
        for mode in (1, 2):
            grad_a = tip_field(mode, np.linalg.norm(x, axis=1), np.arctan2(x[:, 1], x[:, 0]))
            sigma_a = stress(grad_a)
            flux = np.einsum("mij,mi->mj", sigma, grad_a[:, :, 0]) + np.einsum("mij,mi->mj", sigma_a, grad_u[:, :, 0])
            flux[:, 0] -= np.einsum("mij,mij->m", sigma, grad_a)
            k[mode - 1] += np.sum(weight * det * np.einsum("mj,mj->m", flux, grad_q))
    return k * E / (2 * (1 - NU**2))


def nearest(nodes, x):
    return int(np.argmin(np.linalg.norm(nodes - x, axis=1)))


def specimen_factors(angle_deg, notch_ratio, span_ratio, refinement=1.0, domain=0.4):
    """Y_I and Y_II of the semicircular bending specimen; the domain of integration is a part of the notch length,
    small enough to leave out the surface of the specimen."""
    angle = np.radians(angle_deg)
    direction = np.array([np.sin(angle), np.cos(angle)])
    tip = notch_ratio * direction
    s = span_ratio
    corners = [(-1, 0), (-s, 0), (0, 0), (s, 0), (1, 0), (0, 1)]
    nodes, triangles = mesh(corners, (4, 5), 2, tip, 0.01 * notch_ratio / refinement, 0.06 / refinement)
    nodes = quarter_points(nodes, triangles, tip)
    left, right, top = (nearest(nodes, x) for x in ((-s, 0), (s, 0), (0, 1)))
    forces = np.zeros_like(nodes)
    forces[top, 1] = -1.0
    u = displacements(nodes, triangles, forces, [(left, 1), (right, 1), (top, 0)])
    k = stress_intensity(nodes, triangles, u, tip, direction, domain * notch_ratio)
    return k * [1, -1] / (0.5 * np.sqrt(np.pi * notch_ratio)), len(nodes)  # leaning to +x: sliding is negative


def plate_factors(width, height, length, angle_deg):
    """K / (sigma sqrt(pi a)) of a crack from the left side of a plate under tension, `angle_deg` from that side's normal."""
    angle = np.radians(angle_deg)
    direction = np.array([np.cos(angle), np.sin(angle)])
    tip = length * direction
    corners = [(0, -height), (width, -height), (width, height), (0, height), (0, 0)]
    nodes, triangles = mesh(corners, (), 4, tip, 0.01 * length, 0.1 * width)
    nodes = quarter_points(nodes, triangles, tip)
    forces = np.zeros_like(nodes)
    edges = np.concatenate([triangles[:, [0, 1, 3]], triangles[:, [1, 2, 4]], triangles[:, [2, 0, 5]]])
    for a, b, middle in edges:
        y = nodes[[a, b], 1]
        if np.all(np.abs(np.abs(y) - height) < 1e-9 * height) and y[0] * y[1] > 0:
            pull = np.sign(y[0]) * abs(nodes[a, 0] - nodes[b, 0])
            for node, part in ((a, 1 / 6), (b, 1 / 6), (middle, 4 / 6)):
                forces[node, 1] += part * pull
    corner, other = nearest(nodes, (width, -height)), nearest(nodes, (width, height))
    u = displacements(nodes, triangles, forces, [(corner, 0), (corner, 1), (other, 0)])
    return stress_intensity(nodes, triangles, u, tip, direction, 0.4 * length) / np.sqrt(np.pi * length)


def failure_load(y):
    """Load, N, at which the largest hoop stress at the tip reaches that of K_Ic (Erdogan and Sih 1963)."""
    theta = np.linspace(-np.pi, np.pi, 200001)
    hoop = np.cos(theta / 2) * (y[0] * np.cos(theta / 2)**2 - 1.5 * y[1] * np.sin(theta))
    return K_IC * 2 * RADIUS * THICKNESS / (np.sqrt(np.pi * NOTCH) * hoop.max())


def check():
    print("plate with an edge crack of half its width, tension: F = %.4f, Tada's formula 2.8266 (0.5 %%)"
          % plate_factors(1.0, 3.0, 0.5, 0.0)[0])
    f = plate_factors(60.0, 60.0, 1.0, 45.0)
    print("edge crack at 45 degrees, 1/60 of a plate: F_I = %.4f, F_II = %.4f; half plane 0.705, 0.364" % (f[0], f[1]))
    a, s = NOTCH / RADIUS, HALF_SPAN / RADIUS
    for b in (0.4, 0.5, 0.6):
        formula = -1.297 + 9.516 * 0.5 - (0.47 + 16.457 * 0.5) * b + (1.071 + 34.401 * 0.5) * b**2
        print("straight notch, a/r %.1f, half span/r 0.5: Y_I = %.4f; ISRM's polynomial %.4f"
              % (b, specimen_factors(0.0, b, 0.5)[0][0], formula))
    for angle in (0.0, 30.0, 54.0):
        for refinement in (0.5, 1.0, 2.0):
            for domain in (0.2, 0.3, 0.4):  # of a; 0.5 a reaches the flat side when the notch leans
                y, n = specimen_factors(angle, a, s, refinement, domain)
                print("%4.0f degrees, %6d nodes, domain %.1f a: Y_I %8.5f, Y_II %8.5f" % (angle, n, domain, *y))


def write(folder):
    angles = list(range(61))
    factors = [specimen_factors(a, NOTCH / RADIUS, HALF_SPAN / RADIUS)[0] for a in angles]
    table = {
        "name": "stress intensity factors of the semicircular bending specimen",
        "source": "linear-elastic finite elements, scripts/scb_stress_intensity.py",
        "units": "K = P / (2 r t) sqrt(pi a) Y; angle of the notch from the vertical; Y_I < 0: the notch closes",
        "notch_ratio": round(NOTCH / RADIUS, 6),
        "span_ratio": HALF_SPAN / RADIUS,
        "angle_deg": angles,
        "Y_I": [round(float(y[0]), 4) for y in factors],
        "Y_II": [round(float(y[1]), 4) for y in factors],
    }
    lines = ",\n".join(f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in table.items())
    (folder / "scb_stress_intensity.json").write_text("{\n" + lines + "\n}\n")
    rows = ["angle_deg,peak_load,K_I,K_II"]
    for angle, y in zip(angles, factors):
        load = failure_load(y)
        k = load / (2 * RADIUS * THICKNESS) * np.sqrt(np.pi * NOTCH) * y
        rows.append(f"{angle},{load:.2f},{k[0]:.1f},{k[1]:.1f}")
    (folder / "scb_lefm.csv").write_text("\n".join(rows) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare with known results, write nothing")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent.parent / "data/reference")
    arguments = parser.parse_args()
    check() if arguments.check else write(arguments.out)


if __name__ == "__main__":
    main()
