#pragma once

namespace insonify {

/// The largest resident set of this process since it was made, or since the last mark [MiB].
class PeakMemory {
 public:
  /// Forgets the peak so far, where the system allows it (Linux); else the peak is that of the whole process.
  void mark();
  double mib() const;
};

}  // namespace insonify
