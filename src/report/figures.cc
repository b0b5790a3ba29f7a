#include "report/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>

#include "figure.h"
#include "report/contact_curves.h"
#include "report/number_text.h"
#include "report/scale.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

namespace fs = std::filesystem;

class Set {
 public:
  Set(const Result &result, const fs::path &directory, FigureFormat format)
      : result_(result),
        directory_(directory),
        format_(format),
        scale_(suitable_scale(result)),
        moment_("t = " + number_text(result.times.back(), 4) + " s") {}

  void setting() {
    if (result_.boundaries.empty())
      return;
    Figure figure(result_, format_, 0, legend_height(result_, format_));
    figure.title("Physical setting");
    figure.setting();
    write(figure, "setting");
  }

  void deformed() {
    Figure figure(result_, format_, scale_, 0);
    figure.title("Deformed mesh, " + moment_);
    figure.say_scale();
    figure.mesh();
    figure.outline();
    write(figure, "deformed");
  }

  void field(const Field &field, std::size_t component, const std::string &file) {
    const std::string &name = field.components[component];
    Figure figure(result_, format_, scale_, colour_bar_height);
    figure.title(title_of(field.name) + (name.empty() ? "" : " " + name) + ", " + moment_);
    figure.say_scale();
    figure.say_origin(field.origin());
    figure.field(field, component);
    figure.outline();
    write(figure, file + (name.empty() ? "" : "_" + name));
  }

  std::vector<fs::path> files;

 private:
  static std::string title_of(std::string name) {
    if (name == "von_mises" || name == "recovered_von_mises")
      return "von Mises stress";
    if (name == "potential")
      return "Electric potential";
    if (name.starts_with("recovered_"))
      name = name.substr(std::string_view("recovered_").size());
    std::replace(name.begin(), name.end(), '_', ' ');
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
  }

  void write(Figure &figure, const std::string &name) {
    files.push_back(directory_ / (name + "." + name_of(format_)));
    figure.write(files.back());
  }

  const Result &result_;
  fs::path directory_;
  FigureFormat format_;
  double scale_;
  std::string moment_;
};

std::string all_of(const Field &field) {
  std::string list;
  for (const std::string &component : field.components)
    list += (list.empty() ? "" : ", ") + field.name + (component.empty() ? "" : "." + component);
  return list;
}

std::string all_fields(const Result &result) {
  std::string list;
  for (const Field &field : result.fields)
    list += (list.empty() ? "" : ", ") + all_of(field);
  const std::string curves = contact_curve_names(result);
  return list + (curves.empty() ? "" : "; along the contact " + curves);
}

/// NAME or NAME.COMPONENT
void draw_named(Set &set, const Result &result, const std::string &wanted,
                const std::string &file = "") {
  const std::size_t dot = wanted.find('.');
  const std::string component = dot == std::string::npos ? "" : wanted.substr(dot + 1);
  if (const Field *field = result.field(wanted.substr(0, dot)))
    for (std::size_t c = 0; c < field->components.size(); ++c)
      if (field->components[c] == component)
        return set.field(*field, c, file.empty() ? field->name : file);
  if (const Field *field = result.field(wanted.substr(0, dot)))
    throw CaseError(fmt::format("the field \"{}\" {}; give one of {}", field->name,
                                component.empty()
                                    ? "has components, and a figure shows one number at each place"
                                    : "has no component \"" + component + "\"",
                                all_of(*field)));
  throw CaseError(fmt::format("there is no field \"{}\" in the results; there are {}", wanted,
                              all_fields(result)));
}

void make(const fs::path &directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error)
    throw MachineError(
        fmt::format("cannot make the folder {}: {}", directory.string(), error.message()));
}

}  // namespace

std::vector<fs::path> write_figures(const fs::path &folder, const fs::path &directory,
                                    const FigureRequest &request) {
  const Result result = read_result(folder, {0, request.time, true});
  std::vector<std::string> fields = request.fields, curves;
  std::copy_if(fields.begin(), fields.end(), std::back_inserter(curves), is_contact_curve);
  std::erase_if(fields, is_contact_curve);
  if (result.points.empty() && (!fields.empty() || curves.empty()))
    throw CaseError(folder.string() +
                    ": holds no fields to draw; run the case with output.fields = true");
  make(directory);
  std::vector<fs::path> drawn;
  for (const std::string &wanted : curves) {
    const auto files =
        write_contact_curves(result, wanted, request.time, directory, request.format);
    drawn.insert(drawn.end(), files.begin(), files.end());
  }
  if (fields.empty() && !curves.empty())
    return drawn;
  Set set(result, directory, request.format);
  for (const std::string &wanted : fields)
    draw_named(set, result, wanted);
  if (!fields.empty()) {
    drawn.insert(drawn.begin(), set.files.begin(), set.files.end());
    return drawn;
  }
  set.setting();
  set.deformed();
  for (const char *name : {"potential", "temperature"})
    if (result.field(name))
      draw_named(set, result, name);
  for (const char *name : {"recovered_von_mises", "von_mises"})
    if (result.field(name)) {
      draw_named(set, result, name, "von_mises");
      break;
    }
  return set.files;
}

}  // namespace tourmaline::report
