#pragma once

#include <span>
#include <string>

#include "output/probe_rows.h"
#include "output/records.h"

/// The tables of a run as text: comma-separated, a header line, '\n' line ends, SI units, 17
/// significant digits, so that every number reads back as it was. Negative zero is written 0,
/// whatever is not a number nan. The z columns are there only when `dimension` is 3.
namespace tourmaline::output {

/// x,y[,z],u_x,u_y[,u_z],potential,temperature
std::string nodes_header(int dimension);
/// Rows of the points from `first` to before `end`, in the order of the grid. Throws
/// std::invalid_argument when a field does not have one value for each of all points.
std::string nodes_lines(int dimension, const std::vector<Vector3> &points,
                        const PointFields &fields, std::size_t first, std::size_t end);

/// step,time,x,y[,z],normal_traction,tangential_traction_x,tangential_traction_y[,..._z],
/// normal_displacement,slip_x,slip_y[,slip_z],slip_rate,status,temperature,potential,heat_flux,gap,
/// charge_flux, then the row's own quantities
std::string contact_header(int dimension, const ContactRow &row);
std::string contact_lines(int dimension, int step, double time, std::span<const ContactRow> rows);

/// step,time,newton_iterations,residual,stick,slip,open, then the row's own quantities
std::string history_header(const HistoryRow &row);
std::string history_line(const HistoryRow &row);

/// step,time, then the probe's own columns; a line for each of its rows
std::string probe_header(const ProbeRows &probe);
std::string probe_lines(int step, double time, const ProbeRows &probe);

}  // namespace tourmaline::output
