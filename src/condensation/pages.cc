#include "condensation/pages.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <fstream>

#include "tourmaline/error.h"

namespace tourmaline::condensation {

namespace {

// A virtual machine may give free blocks of 2^order pages and larger ones back to its host, which
// has to find them anew when they are used. Smaller pieces it has kept (docs/factorisation.md).
bool gives_huge_pages_back() {
  constexpr unsigned of_huge_pages = 9;
  std::ifstream file("/sys/module/page_reporting/parameters/page_reporting_order");
  unsigned order = 0;
  return file >> order && order <= of_huge_pages;
}

}  // namespace

Pages::Pages(std::size_t doubles) : size_(doubles) {
  if (size_ == 0)
    return;
  void *pages = mmap(nullptr, size_ * sizeof(double), PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED)
    throw MachineError(fmt::format(
        "not enough memory for a factorisation: {:.3g} GiB in one piece are not to be had; use a "
        "coarser mesh",
        static_cast<double>(size_) * sizeof(double) / (1 << 30)));
  static const bool takes_small_ones = gives_huge_pages_back();
  madvise(pages, size_ * sizeof(double), takes_small_ones ? MADV_POPULATE_WRITE : MADV_HUGEPAGE);
  data_ = static_cast<double *>(pages);
}

Pages::~Pages() {
  if (data_ != nullptr)
    munmap(data_, size_ * sizeof(double));
}

double *Stack::push(std::size_t doubles) {
  double *begin = pages_.data() + used_;
  used_ += doubles;
  if (touched_ > used_ - doubles)  // what lies beyond has never been used
    std::fill(begin, begin + std::min(doubles, touched_ - (used_ - doubles)), 0.);
  touched_ = std::max(touched_, used_);
  return begin;
}

}  // namespace tourmaline::condensation
