#include "page_template.h"

#include <cstddef>

// Defined by the object file that cmake/EmbedPage.cmake makes of the page.
extern "C" {
extern const char tourmaline_report_page[];
extern const char tourmaline_report_page_end[];
}

namespace tourmaline::report {

std::string_view page_template() {
  return {tourmaline_report_page,
          static_cast<std::size_t>(tourmaline_report_page_end - tourmaline_report_page)};
}

}  // namespace tourmaline::report
