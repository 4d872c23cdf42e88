#include <algorithm>

#include "simulate/synthesizer_table_internal.hpp"

namespace insonify {

Synthesizer SynthesizerTable::of(Part part, const SonarHead& head, const Medium& medium, SynthesisMethod method,
                                 const SynthesisOptions& options) {
  const std::scoped_lock lock(guard_);  // a synthesizer makes its tables in its first image, outside of this lock
  std::vector<Row>& rows = rows_[static_cast<std::size_t>(part)];
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.medium == medium && row.method == method && row.options == options;
  });
  if (at != rows.end()) {
    std::rotate(rows.begin(), at, at + 1);
  } else {
    rows.insert(rows.begin(), {medium, method, options, Synthesizer(head, medium, method, options)});
    if (rows.size() > most) rows.pop_back();
  }
  return rows.front().synthesizer;
}

}  // namespace insonify
