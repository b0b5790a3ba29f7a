#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tourmaline::report {

/// The numbers of a DataArray: the counterpart of output::vtk_binary. `type` is VTK's name of the
/// number type. Throws CaseError, which begins with `name`, when the text is damaged.
std::vector<double> read_vtk_binary(std::string_view text, const std::string &type,
                                    const std::string &name);

}  // namespace tourmaline::report
