// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "simulate/synthesizer_table_internal.hpp"

namespace insonify {

std::shared_ptr<const Synthesizer> SynthesizerTable::of(Part part, const SonarHead& head, const Medium& medium,
                                                        SynthesisMethod method, const SynthesisOptions& options) {
  const std::scoped_lock lock(guard_);  // a synthesizer makes its tables in its first image, outside of this lock
  std::vector<Row>& rows = rows_[static_cast<std::size_t>(part)];
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const Row& row) {
    return row.medium == medium && row.method == method && row.options == options;
  });
  if (at != rows.end()) {
    std::rotate(rows.begin(), at, at + 1);
    return rows.front().synthesizer;
  }
  rows.insert(rows.begin(), {medium, method, options, std::make_shared<Synthesizer>(head, medium, method, options)});
  std::vector<Medium> media;  // the last used first
  for (const Row& row : rows)
    if (std::find(media.begin(), media.end(), row.medium) == media.end()) media.push_back(row.medium);
  if (media.size() > most_media) std::erase_if(rows, [&](const Row& row) { return row.medium == media.back(); });
  return rows.front().synthesizer;
}

std::shared_ptr<const CellSynthesizer> SynthesizerTable::cells_of(const SonarHead& head, const Medium& medium,
                                                                  double sample_length) {
  return cells_.of({medium, head.gate, sample_length}, [&] { return CellSynthesizer(head, medium, sample_length); });
}

}  // namespace insonify
