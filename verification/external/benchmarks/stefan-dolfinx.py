"""Implicit enthalpy method on linear triangles: an external solver of meltfront, in dolfinx with PETSc.

dH/dt = div grad u + f with Kirchhoff's variable u = k_phase (T - T_m), lumped masses and BDF2 that starts with short steps. Each
step m H + c K u(H) = b is solved by Newton's method in the enthalpy H, which is the source-based method of Swaminathan and
Voller (1992) without a width of a mushy zone; K is assembled once, and a step changes the diagonal only.
"""
import json
import sys

import basix
import numpy as np
import ufl
from dolfinx import fem, geometry, mesh
from mpi4py import MPI
from petsc4py import PETSc

request = json.load(sys.stdin)
scene, n, options = request["scene"], request["n"], request["options"]
material, domain, initial = scene["material"], scene["domain"], scene["initial"]
melting = material["melting_temperature"]["value"]
solid, liquid = ({key: value["value"] for key, value in material[phase].items()} for phase in ("solid", "liquid"))
latent = solid["density"] * material["latent_heat"]["value"]
capacity_solid, capacity_liquid = (solid["density"] * phase["specific_heat_capacity"] for phase in (solid, liquid))
diffusivity_solid, diffusivity_liquid = solid["conductivity"] / capacity_solid, liquid["conductivity"] / capacity_liquid
lower, upper = (np.array(domain[corner]["values"]) for corner in ("lower", "upper"))
h = domain["side"]["value"] / n
cells = np.rint((upper - lower) / h).astype(int)
if not initial["temperature"]["constant"] or not np.allclose(cells * h, upper - lower):
    print(json.dumps({"kind": "refused", "reason": "takes one initial temperature and whole cells in both directions"}))
    sys.exit()

body = mesh.create_rectangle(MPI.COMM_SELF, [lower, upper], cells, mesh.CellType.triangle)
V = fem.FunctionSpace(body, ("Lagrange", 1))
trial, test = ufl.TrialFunction(V), ufl.TestFunction(V)
K = fem.petsc.assemble_matrix(fem.form(ufl.inner(ufl.grad(trial), ufl.grad(test)) * ufl.dx))
K.assemble()
m = fem.petsc.assemble_vector(fem.form(test * ufl.dx)).array.copy()
places, diagonal_of_K = V.tabulate_dof_coordinates(), K.getDiagonal().array.copy()


def at(table, time):
    """Values of a table at a time, linear between its times."""
    i = np.clip(np.searchsorted(table[0], time), 1, len(table[0]) - 1)
    share = (time - table[0][i - 1]) / (table[0][i] - table[0][i - 1])
    return (1 - share) * table[1][i - 1] + share * table[1][i]


def shape_functions(point):
    """Of all nodes at a point: how a line source is shared."""
    point = np.array([[*point, 0]])
    found = geometry.compute_collisions(geometry.BoundingBoxTree(body, 2), point)
    cell = geometry.compute_colliding_cells(body, found, point).links(0)[0]
    corners = body.geometry.x[body.geometry.dofmap.links(cell)][:, :2]
    element = basix.create_element(basix.ElementFamily.P, basix.CellType.triangle, 1)
    shares = np.zeros(len(m))
    shares[V.dofmap.cell_dofs(cell)] = element.tabulate(0, body.geometry.cmap.pull_back(point[:, :2], corners))[0, 0].reshape(-1)
    return shares


sources = [(shape_functions(source["position"]["values"]), [np.array(source["energy"][key]) for key in ("times", "values")])
           for source in scene["sources"]]
walls, held = [], np.zeros(len(m), dtype=bool)
for name, wall in scene["walls"].items():
    if wall["kind"] == "insulated":
        continue
    d, end = "xy".index(name[0]), lower if name.endswith("min") else upper
    nodes = fem.locate_dofs_geometrical(V, lambda x: np.isclose(x[d], end[d], atol=1e-6 * h))
    nodes = nodes[np.argsort(places[nodes, 1 - d])]
    samples = wall["temperature"].get("samples") or {"times": [0, 1], "values": [[wall["temperature"]["value"]] * len(nodes)] * 2}
    walls.append((nodes, [np.array(samples[key], dtype=float) for key in ("times", "values")]))
    held[nodes] = True


def enthalpy(T):
    return np.where(T < 0, capacity_solid * T, np.where(T > 0, latent + capacity_liquid * T, melted))


def hold_walls(H, time):
    for nodes, table in walls:
        H[nodes] = enthalpy(at(table, time) - melting)


def potential(H):
    """Kirchhoff's variable, and its derivative, zero where a node is melting."""
    return (diffusivity_solid * np.minimum(H, 0) + diffusivity_liquid * np.maximum(H - latent, 0),
            np.where(H < 0, diffusivity_solid, np.where(H > latent, diffusivity_liquid, 0)))


def conducted(u):
    vector.array[:] = u
    K.mult(vector, product)
    return product.array.copy()


vector, product, A, scale = K.createVecRight(), K.createVecRight(), K.duplicate(), 0
solver = PETSc.KSP().create(MPI.COMM_SELF)
solver.setType("cg")
solver.getPC().setType("icc")
solver.setTolerances(rtol=1e-3)
solver.setOperators(A)
linear_iterations = 0


def solve(H, b, c):
    """m H + c K u = b at nodes that are not held, from a guess. What is left in the end is given to H: the balance is closed."""
    global scale, linear_iterations
    if abs(c - scale) > 1e-9 * c:
        scale = c
        K.copy(A)
        A.scale(c)
    for _ in range(200):
        u, slope = potential(H)
        r = np.where(held, 0, b - m * H - c * conducted(u))
        if np.abs(r / m).max() < options["tolerance"] * latent:
            return H + r / m, c * conducted(u)
        free = (slope > 0) & ~held
        slope = np.where(free, slope, 1)
        vector.array[:] = np.where(free, c * diagonal_of_K + m / slope, 1e6 * c * diagonal_of_K)
        A.setDiagonal(vector)
        vector.array[:] = np.where(free, r, 0)
        solver.solve(vector, product)
        linear_iterations += solver.getIterationNumber()
        change = np.where(free, product.array, 0)
        H = H + np.where(free, change / slope, np.where(held, 0, (r - c * conducted(change)) / m))
    sys.exit("Newton's method does not converge in 200 iterations")


start, times = scene["start_time"]["value"], request["times"]["values"]
longest = (scene["end_time"]["value"] - start) / max(options["steps_per_cell"] * n, options["least_steps"])
melted = latent * (1 - initial["solid_fraction_at_melting"]["value"])
H = np.full(len(m), float(enthalpy(initial["temperature"]["value"] - melting)))
hold_walls(H, start)
given = lambda time: sum((shares * at(table, time) for shares, table in sources), np.zeros(len(m)))
print(json.dumps({"kind": "start", "protocol": 1, "spacing": h, "time_step": longest, "unknowns": int((~held).sum()),
                  "positions": places[:, :2].T.tolist(), "weights": m.tolist()}))
time, steps, before, change, got, boundary, through = start, 0, 0, 0 * m, 0 * m, 0, 0
for wanted in times:
    count = int(np.ceil((wanted - time) / longest - 1e-9))
    lengths = [(wanted - time) / max(count, 1)] * count
    if steps == 0:
        lengths[:1] = [dt * part for dt in lengths[:1] for part in (1 / 8, 1 / 8, 1 / 4, 1 / 2)]
    for i, dt in enumerate(lengths):
        # As an increment: (H - H_n) = share (H_n - H_n-1) + c rate; heat from sources and walls likewise.
        ratio, next = dt / before if before else 0, time + dt if i + 1 < len(lengths) else wanted
        share, c = ratio**2 / (1 + 2 * ratio), (1 + ratio) / (1 + 2 * ratio) * dt
        load = given(next) - given(time)
        b = m * (H + share * change) + load - share * got
        guess = H + ratio * change
        hold_walls(guess, next)
        result, leaving = solve(guess, b, c)
        through = share * through + float((m * result + leaving - b)[held].sum())
        change, got, H, before, time = result - H, load, result, dt, next
        boundary, steps = boundary + through, steps + 1
    sensible = np.minimum(H, 0) + np.maximum(H - latent, 0)
    T = melting + np.where(sensible < 0, sensible / capacity_solid, sensible / capacity_liquid)
    fraction = np.clip(1 - H / latent, 0, 1)
    heat = {"stored": float(m @ sensible), "latent": float(m @ (latent * (1 - fraction))), "boundary": boundary,
            "sources": float(given(time).sum())}
    print(json.dumps({"kind": "snapshot", "time": time, "temperature": T.tolist(), "solid_fraction": fraction.tolist(), "heat": heat}))
print(json.dumps({"kind": "end", "steps": steps, "solver_iterations": linear_iterations}))
