#pragma once

namespace tourmaline::verified {

/// Bodies with symmetry planes and rollers: nodes of which some displacement components are
/// prescribed and others are free, in contact and beside it. Loads and bound are such that some
/// contact nodes stick and others slip.

/// A quarter of a block, pressed down and pulled along its contact.
constexpr const char *quarter_block = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.04, 0.04, 0.04], cells = [4, 4, 4], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 4 }
boundary = [
  { on = "left", displacement = [0, "free", "free"] },
  { on = "front", displacement = ["free", 0, "free"] },
  { on = "bottom", potential = 0 },
  { on = "top", potential = "100*t", temperature = 0, traction = [0, 0, "-1e5*t^2"] },
  { on = "right", traction = ["3e4*sin(3*t)", "2e4*t", 0] } ]
contact = { on = "bottom", friction = { law = "tresca", bound = 1e4 } }
)toml";

/// A block on rollers that move, without contact.
constexpr const char *rollers = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.04, 0.03, 0.05], cells = [4, 3, 5], cell = "hexahedron" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
boundary = [
  { on = "right", displacement = [0, 0, 0], potential = 0, temperature = 0 },
  { on = "left", displacement = ["1e-9*t", "free", "free"] },
  { on = "top", traction = [0, 2000, -3000] } ]
)toml";

/// A sleeve whose lower rim is held across the shaft, so that the normals of its contact nodes are
/// tilted to the axes that are prescribed, and whose upper rim is pushed along.
constexpr const char *rimmed_sleeve = R"toml(
mesh.annulus = { inner = 0.02, outer = 0.04, height = 0.02, cells = [2, 12, 3], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [
  { on = "outer", displacement = ["-1e-8*x*t - 4e-8*y*sin(4*t)", "-1e-8*y*t + 4e-8*x*sin(4*t)", "free"], potential = 0, temperature = 0 },
  { on = "bottom", displacement = ["2e-11*t", "free", "free"] },
  { on = "top", displacement = ["free", "free", "1e-9*sin(4*t)"] } ]
contact = { on = "inner", friction = { law = "tresca", bound = 1000 } }
)toml";

/// A plane block between a roller and its contact, whose ends the roller holds along or across.
constexpr const char *plane_between_rollers = R"toml(
mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = [8, 8] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 0.1, steps = 5 }
boundary = [
  { on = "right", displacement = ["-1e-10*t", "free"], potential = 0, temperature = 0 },
  { on = "bottom", displacement = ["free", "2e-10*t"] },
  { on = "top", temperature = 0, traction = ["300*t", "-1000*t"] } ]
contact = { on = "left", friction = { law = "tresca", bound = 15 }, heat = { law = "exchange", coefficient = 1, foundation_temperature = -27 } }
)toml";

}  // namespace tourmaline::verified
