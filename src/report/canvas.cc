#include "report/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cstring>

#include "output/atomic_file.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

constexpr double pixels_per_point = 300. / 72;

cairo_status_t append(void *text, const unsigned char *bytes, unsigned int n) {
  static_cast<std::string *>(text)->append(reinterpret_cast<const char *>(bytes), n);
  return CAIRO_STATUS_SUCCESS;
}

cairo_surface_t *make_surface(FigureFormat format, double width, double height, std::string &file) {
  if (format == FigureFormat::svg)
    return cairo_svg_surface_create_for_stream(append, &file, width, height);
  if (format == FigureFormat::pdf)
    return cairo_pdf_surface_create_for_stream(append, &file, width, height);
  return cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(width * pixels_per_point),
                                    static_cast<int>(height * pixels_per_point));
}

}  // namespace

FigureFormat figure_format(const std::string &name) {
  for (const FigureFormat format : {FigureFormat::svg, FigureFormat::png, FigureFormat::pdf})
    if (name == name_of(format))
      return format;
  throw CaseError("figures are written as svg, png or pdf, not as \"" + name + "\"");
}

const char *name_of(FigureFormat format) {
  switch (format) {
    case FigureFormat::svg:
      return "svg";
    case FigureFormat::png:
      return "png";
    case FigureFormat::pdf:
      return "pdf";
  }
  return "";
}

struct Canvas::Sheet {
  Sheet(FigureFormat given, double width, double height)
      : format(given),
        surface(make_surface(given, width, height, file)),
        pen(cairo_create(surface)) {}
  ~Sheet() {
    cairo_destroy(pen);
    cairo_surface_destroy(surface);
  }
  Sheet(const Sheet &) = delete;
  Sheet &operator=(const Sheet &) = delete;

  void ink(const Colour &colour) const {
    cairo_set_source_rgb(pen, colour[0] / 255., colour[1] / 255., colour[2] / 255.);
  }
  void font(double size, bool bold) const {
    cairo_select_font_face(pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(pen, size);
  }

  FigureFormat format;
  std::string file;
  cairo_surface_t *surface;
  cairo_t *pen;
};

Canvas::Canvas(FigureFormat format, double width, double height)
    : sheet_(std::make_unique<Sheet>(format, width, height)) {
  if (format == FigureFormat::png)
    cairo_scale(sheet_->pen, pixels_per_point, pixels_per_point);
  sheet_->ink({255, 255, 255});
  cairo_paint(sheet_->pen);
}

Canvas::~Canvas() = default;

void Canvas::lines(const std::vector<std::vector<Point>> &paths, const Colour &colour,
                   double width) {
  cairo_t *pen = sheet_->pen;
  sheet_->ink(colour);
  cairo_set_line_width(pen, width);
  cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
  cairo_new_path(pen);
  for (const std::vector<Point> &path : paths)
    for (std::size_t i = 0; i < path.size(); ++i)
      (i == 0 ? cairo_move_to : cairo_line_to)(pen, path[i][0], path[i][1]);
  cairo_stroke(pen);
}

void Canvas::area(const std::vector<Point> &corners, const Colour &colour) {
  sheet_->ink(colour);
  cairo_new_path(sheet_->pen);  // letters leave the pen where they end
  for (const Point &corner : corners)
    cairo_line_to(sheet_->pen, corner[0], corner[1]);
  cairo_close_path(sheet_->pen);
  cairo_fill(sheet_->pen);
}

void Canvas::picture(const Raster &raster, const Point &at, double width) {
  cairo_t *pen = sheet_->pen;
  cairo_surface_t *image =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, raster.width(), raster.height());
  cairo_surface_flush(image);
  unsigned char *rows = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int y = 0; rows && y < raster.height(); ++y)
    std::memcpy(rows + static_cast<std::ptrdiff_t>(y) * stride,
                &raster.pixels()[static_cast<std::size_t>(y) * raster.width()],
                4 * static_cast<std::size_t>(raster.width()));
  cairo_surface_mark_dirty(image);
  cairo_save(pen);
  cairo_translate(pen, at[0], at[1]);
  cairo_scale(pen, width / raster.width(), width / raster.width());
  cairo_set_source_surface(pen, image, 0, 0);
  cairo_paint(pen);
  cairo_restore(pen);
  cairo_surface_destroy(image);
}

void Canvas::colour_strip(const ColourMap &map, const Point &at, double width, double height) {
  cairo_pattern_t *gradient = cairo_pattern_create_linear(at[0], 0, at[0] + width, 0);
  constexpr int stops = 32;
  for (int i = 0; i <= stops; ++i) {
    const Colour &c = map[static_cast<std::size_t>(i) * (map.size() - 1) / stops];
    cairo_pattern_add_color_stop_rgb(gradient, static_cast<double>(i) / stops, c[0] / 255.,
                                     c[1] / 255., c[2] / 255.);
  }
  cairo_rectangle(sheet_->pen, at[0], at[1], width, height);
  cairo_set_source(sheet_->pen, gradient);
  cairo_fill(sheet_->pen);
  cairo_pattern_destroy(gradient);
}

double Canvas::text_width(const std::string &text, double size, bool bold) {
  sheet_->font(size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(sheet_->pen, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(const std::string &text, const Point &at, Align align, double size, bool bold,
                  bool upward) {
  cairo_t *pen = sheet_->pen;
  const double width = text_width(text, size, bold);
  sheet_->ink({29, 33, 39});
  cairo_save(pen);
  cairo_translate(pen, at[0], at[1]);
  if (upward)
    cairo_rotate(pen, -1.5707963267948966);
  cairo_move_to(pen, align == Align::left ? 0 : align == Align::middle ? -width / 2 : -width, 0);
  cairo_show_text(pen, text.c_str());
  cairo_restore(pen);
}

void Canvas::write(const std::filesystem::path &path) {
  cairo_status_t status = cairo_status(sheet_->pen);
  if (sheet_->format == FigureFormat::png && status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_write_to_png_stream(sheet_->surface, append, &sheet_->file);
  cairo_surface_finish(sheet_->surface);
  if (status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_status(sheet_->surface);
  if (status != CAIRO_STATUS_SUCCESS && status != CAIRO_STATUS_SURFACE_FINISHED)
    throw MachineError(path.string() + " cannot be drawn: " + cairo_status_to_string(status));
  output::write_file(path, sheet_->file);
}

}  // namespace tourmaline::report
