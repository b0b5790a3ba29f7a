"""What answers the state of a contact node, with derivatives. delta = u_nu - u_f.nu - g [m], positive when pressed in;
p = -sigma_nu [N/m^2]; d the slip increment of the step, k its length. All arrays are over the nodes."""
import numpy as np


def ramp(delta, length):
    """psi = clamp(1 + delta/ramp, 0, 1), 1 without a ramp; and dpsi/ddelta."""
    if length is None:
        return np.ones_like(delta), np.zeros_like(delta)
    inside = (delta < 0) & (delta > -length)
    return np.clip(1 + delta / length, 0, 1), np.where(inside, 1 / length, 0)


def pressed_exchange(p, table):
    """coefficient (p/reference)^exponent of a pressure p > 0, else 0 [W/(K m^2)]; and its derivative by p."""
    if table is None:
        return np.zeros_like(p), np.zeros_like(p)
    share = np.where(p > 0, p, 1) / table["reference"]
    value = table["coefficient"] * share ** table["exponent"]
    return np.where(p > 0, value, 0), np.where(p > 0, value * table["exponent"] / np.where(p > 0, p, 1), 0)


def friction_coefficient(table, size, slid, k):
    """mu and dmu/d|d|; slid: accumulated before the step."""
    mu = table["coefficient"]
    if not isinstance(mu, dict):
        return np.full_like(size, mu), np.zeros_like(size)
    scale = mu["speed"] * k if "speed" in mu else mu["distance"]
    drop = (mu["static"] - mu["kinetic"]) * np.exp(-((size if "speed" in mu else slid + size)) / scale)
    return mu["kinetic"] + drop, -drop / scale


def friction_bound(table, p, closed, size, slid, k):
    """Bound on the tangential traction [N/m^2], with derivatives by p and by |d|. An open node carries none."""
    zero = np.zeros_like(p)
    if table["law"] == "none":
        return zero, zero, zero
    if table["law"] == "tresca":
        return np.where(closed, table["bound"], 0), zero, zero
    mu, slope = friction_coefficient(table, size, slid, k)
    limit, bound = table.get("limit", np.inf), table.get("cohesion", 0) + mu * p  # at least 0 where the contact is pulled
    between = closed & (bound > 0) & (bound < limit)
    return np.where(closed, np.clip(bound, 0, limit), 0), np.where(between, mu, 0), np.where(between, slope * p, 0)


def on_ball(y, bound):
    """The nearest point of the ball of radius bound: value, derivative by y, derivative by the bound."""
    size = np.sqrt((y ** 2).sum(1))
    out = (size > bound) | (bound == 0)
    unit = np.where(out[:, None], y / np.where(size > 0, size, 1)[:, None], 0)
    eye = np.eye(y.shape[1])
    bent = (bound / np.where(size > 0, size, 1))[:, None, None] * (eye - unit[:, :, None] * unit[:, None, :])
    return np.where(out[:, None], bound[:, None] * unit, y), np.where(out[:, None, None], bent, eye), unit, out
