#pragma once
#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

#include <fftw3.h>

namespace insonify {

/// In-place forward complex FFT of one length; plans use FFTW_ESTIMATE, so bits do not depend on timing.
class ForwardFft {
 public:
  explicit ForwardFft(std::size_t n);
  void run(std::vector<std::complex<double>>& data) const;

 private:
  std::unique_ptr<std::remove_pointer_t<fftw_plan>, void (*)(fftw_plan)> plan_;
};

}  // namespace insonify
