// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>

#include "scene_io/raw_cloud_internal.hpp"

namespace insonify {

/// Suppresses PCL's output during its lifetime.
class QuietPcl {
 public:
  QuietPcl() : before_(pcl::console::getVerbosityLevel()) { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~QuietPcl() { pcl::console::setVerbosityLevel(before_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL before_;
};

/// The rows of a PCL cloud, which must outlive the table; sets fields, width and height of `raw`. Throws Error(content)
/// naming raw.path if the cloud's sizes are inconsistent.
RowTable table_of(const pcl::PCLPointCloud2& cloud, RawCloud& raw);

}  // namespace insonify
