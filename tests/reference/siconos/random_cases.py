"""Cases with one contact and one step as texts, the random numbers drawn from what is given."""
OPPOSITE = {"bottom": "top", "top": "bottom", "left": "right", "right": "left"}
ELASTIC = """symmetry = "isotropic"
young = 1e11
eps11 = 1
k11 = 1
density = 1000
specific_heat = 1000
reference_temperature = 293
poisson = """
COUPLED = 'library = "BaTiO3-Liu2014"'
EXCHANGE = 'heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "40*t" }'


def random_case(random, dim):
    """(text, mu): one side held and moved, another one loaded, a gap, a foundation that moves; coupled or elastic, elastic in 3D."""
    number = lambda size: float(f"{size * random.uniform(-1, 1):.4g}")
    side = "bottom" if dim == 3 else str(random.choice(list(OPPOSITE)))
    normal = dim - 1 if side in ("bottom", "top") else 0
    s = "(x/0.02 - y/0.01)" if dim == 3 else "x/0.02" if normal else "y/0.01"
    move = [f"t*({number(1e-6)} + {number(1e-6)}*{s} + {number(3e-7)}*sin({random.integers(1, 9)}*{s}))" for _ in range(dim)]
    move[normal] += f" + {(1 if side in ('top', 'right') else -1) * random.uniform(0, 1.5e-6):.4g}*t"
    coupled = dim == 2 and random.integers(2)
    mu = float(f"{random.uniform(0.1, 1) if random.integers(3) else random.uniform(1, 5):.3g}")
    return f"""title = "Random"
[mesh.box]
min = {[0] * dim}
max = {[0.02, 0.01, 0.01][:dim]}
cells = {[int(n) for n in random.integers(*((3, 25) if dim == 2 else (2, 7)), dim)]}
cell = "{"quadrilateral" if dim == 2 else "hexahedron"}"
[material]
{COUPLED if coupled else ELASTIC + f"{random.uniform(0, 0.45):.3g}"}
[time]
end = 1
steps = 1
[[boundary]]
on = "{OPPOSITE[side]}"
displacement = {move}
potential = 0
temperature = 0
[[boundary]]
on = "{random.choice([b for b in OPPOSITE if b not in (side, OPPOSITE[side])])}"
traction = {[number(3e7) for _ in range(dim)]}
[contact]
on = "{side}"
gap = "{abs(number(5e-7))}*({s} - {random.uniform(0, 1):.2g})^2 + {number(2e-7)}"
foundation_displacement = {[f"{number(8e-7)}*(t - 0.5)" for _ in range(dim)]}
normal = "unilateral"
friction = {{ law = "coulomb", coefficient = {mu} }}
{EXCHANGE if coupled else ""}
[output]
fields = false
""".replace("'", '"'), mu
