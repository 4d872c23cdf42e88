// SPDX-License-Identifier: BSD-3-Clause
// Heads, environments, simulators and pings as bytes, by which processes hand them to each other.
#include <array>
#include <optional>
#include <unordered_set>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/error.hpp"
#include "python/archive_internal.hpp"
#include "python/binding_internal.hpp"
#include "returns/sounding_columns.hpp"
#include "store/environment_file.hpp"
#include "store/sonar_keys.hpp"

// The members of structures that are written: found by Archive through their namespace.
namespace insonify {

using python::Archive;

inline void members(Archive& archive, SourcedNumber& n) { archive(n.key, n.value, n.status, n.source); }
inline void members(Archive& archive, Layer& layer) { archive(layer.name, layer.pressure); }
inline void members(Archive& archive, BeamFan& fan) {
  archive(fan.azimuth, fan.elevation, fan.beam_width, fan.elevation_width, fan.row_width);
}
inline void members(Archive& archive, Motion& motion) { archive(motion.velocity, motion.turn_rate); }
inline void members(Archive& archive, PartView& view) {
  archive(view.world_from_part, view.visible_share, view.azimuth, view.elevation, view.range, view.beam_azimuth,
          view.ahead, view.port, view.scale, view.size);
}
inline void members(Archive& archive, PixelLabels& labels) {
  archive(labels.material, labels.id, labels.share, labels.names, labels.part, labels.part_names, labels.part_labels,
          labels.views, labels.elevation, labels.second, labels.second_share);
}
inline void members(Archive& archive, Ping& ping) {
  archive(ping.number, ping.time, ping.world_from_head, ping.fan, ping.gate, ping.pressure, ping.layers,
          ping.expected_level, ping.display_cells, ping.intensity, ping.unknown, ping.split_phase, ping.labels,
          ping.scan, ping.sound_speed, ping.absorption_db_per_m, ping.motion);
}
inline void members(Archive& archive, Contributors& all) {
  archive(all.beams, all.bins, all.per_pixel, all.surfel, all.id, all.share, all.elevation, all.material, all.path,
          all.surfel_before, all.total);
}
inline void members(Archive& archive, ElementSeries& series) { archive(series.start, series.step, series.pressure); }
inline void members(Archive& archive, Soundings& soundings) {
  archive(soundings.position, soundings.true_order);
  each_common_column([&](const SoundingColumn&, auto& column) { archive(column); }, soundings);
}
inline void members(Archive& archive, PingEvent& event) {
  archive(event.world_from_head, event.motion, event.time, event.number);
}

}  // namespace insonify

namespace insonify::python {
namespace {

/// A file without a name that holds a text as long as the object lives.
class TextInMemory {
 public:
  explicit TextInMemory(const std::string& text) : file_(memfd_create("insonify", MFD_CLOEXEC)) {
    if (file_ < 0 || write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      fail(ErrorKind::runtime, "unpickling: no memory for ", text.size(), " bytes");
  }
  TextInMemory(const TextInMemory&) = delete;
  TextInMemory& operator=(const TextInMemory&) = delete;
  ~TextInMemory() { close(file_); }
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

/// Calls archive(state) for what makes up a sonar; specs are text, whose table of keys has every member.
void pass_sonar(Archive& archive, Sonar& sonar) {
  SonarFile& file = sonar.file;
  std::string of_file = sonar_as_toml(file.spec), spec = sonar_as_toml(sonar.spec);
  archive(of_file, spec, file.description, file.path, file.numbers, file.of_run, file.mounting);
  file.spec = load_sonar_file(TextInMemory(of_file).path()).spec;
  sonar.spec = load_sonar_file(TextInMemory(spec).path()).spec;
}

/// Calls archive(state) for what a ping has without its scene.
void pass_ping(Archive& archive, MadePing& ping) {
  PingOutputs& outputs = ping.made.outputs;
  archive(ping.setup.event, ping.setup.simulation.seed, ping.setup.run.placement.pose, ping.made.ping,
          ping.made.soundings, outputs.contributors, outputs.elements, ping.noted, ping.copied.most, ping.head);
}

/// Returns the instances among those of a scene that the pixels of a ping show.
std::vector<std::array<std::uint32_t, 2>> shown_instances(const MadePing& ping) {
  std::vector<std::array<std::uint32_t, 2>> shown;
  const Grid<std::uint32_t>& ids = ping.made.ping.labels.id;
  const std::unordered_set<std::uint32_t> unique(ids.data(), ids.data() + ids.size());
  for (const std::uint32_t id : unique)
    if (const auto of = ping.instances().of_surfel.find(id); of != ping.instances().of_surfel.end())
      shown.push_back({id, of->second});
  return shown;
}

/// Begins an archive with the version, which must be that of the reader.
void pass_version(Archive& archive) {
  std::string version = INSONIFY_VERSION;
  archive(version);
  if (version != INSONIFY_VERSION)
    fail(ErrorKind::content, "unpickling: was pickled by insonify ", version, ", this is ", INSONIFY_VERSION);
}

template <typename Object, typename Pass>
py::bytes pickled(Object object, const Pass& pass) {
  Archive archive;
  pass_version(archive);
  pass(archive, object);
  return py::bytes(archive.bytes());
}

template <typename Pass>
auto unpickled(const py::bytes& bytes, const Pass& pass) {
  const std::string text = bytes;
  Archive archive{std::string_view(text)};
  pass_version(archive);
  return pass(archive);
}

std::shared_ptr<MadePing> ping_of(const By& by, const py::bytes& bytes) {
  return unpickled(bytes, [&](Archive& archive) {
    auto ping = std::make_shared<MadePing>(MadePing{by, nullptr, by->setup});
    pass_ping(archive, *ping);
    std::vector<std::array<std::uint32_t, 2>> shown;
    archive(shown);
    for (const auto& [id, object] : shown) ping->copied.of_surfel[id] = object;
    return ping;
  });
}

}  // namespace

std::vector<std::pair<std::string, TomlValue>> given_settings(const Run& run) {
  Run given = run, usual;
  const Keywords all = keywords(given), defaults = keywords(usual);
  std::string text;
  for (std::size_t i = 0; i < all.keys.size(); ++i)
    if (const auto value = all.keys[i].value.text(); value && value != defaults.keys[i].value.text())
      text += all.keys[i].name + (" = " + *value) + '\n';
  const TomlValue table = load_toml(TextInMemory(text).path());
  std::vector<std::pair<std::string, TomlValue>> settings;
  for (std::size_t i = 0; i < table.keys.size(); ++i) settings.emplace_back(table.keys[i], table.items[i]);
  return settings;
}

void add_pickling(py::class_<Sonar>& sonar, py::class_<Environment>& environment) {
  sonar.def(py::pickle([](const Sonar& of) { return pickled(of, pass_sonar); },
                       [](const py::bytes& bytes) {
                         return unpickled(bytes, [](Archive& archive) {
                           Sonar read;
                           pass_sonar(archive, read);
                           return read;
                         });
                       }));
  environment.def(
      py::pickle([](const Environment& of) { return py::str(environment_as_toml(of)); },
                 [](const py::str& text) { return load_environment(TextInMemory(std::string(text)).path()); }));
}

void add_pickling(py::class_<Simulator, std::shared_ptr<Simulator>>& simulator) {
  simulator.def(py::pickle(
      [](const Simulator& of) {
        py::dict keys;
        for (const auto& [name, value] : of.given) keys[name.c_str()] = object_of(value);
        return py::make_tuple(of.sonar, of.setup.environment, keys);
      },
      [](const py::tuple& state) {
        return std::make_shared<Simulator>(py::cast<const Sonar&>(state[0]), py::cast<const Environment&>(state[1]),
                                           py::kwargs(py::reinterpret_borrow<py::dict>(state[2])));
      }));
}

void add_pickling(py::class_<MadePing, std::shared_ptr<MadePing>>& ping) {
  ping.def(py::pickle(
      [](const py::object& self) {
        const auto& of = py::cast<const MadePing&>(self);
        const auto notes = py::cast<std::vector<std::string>>(self.attr("notes"));
        const auto bytes = pickled(of, [&](Archive& archive, MadePing& copy) {
          copy.noted = notes, copy.copied.most = of.instances().most;
          auto shown = shown_instances(of);
          pass_ping(archive, copy);
          archive(shown);
        });
        return py::make_tuple(std::const_pointer_cast<Simulator>(of.by), bytes);
      },
      [](const py::tuple& state) {
        return ping_of(py::cast<std::shared_ptr<Simulator>>(state[0]), py::reinterpret_borrow<py::bytes>(state[1]));
      }));
}

}  // namespace insonify::python
