#include "store/mission_table_internal.hpp"

namespace insonify {

TomlValue with_template(const std::string& path, const TomlValue& document, const TomlValue& table) {
  const TomlValue* name = table.find("template");
  if (!name) return table;
  const std::string wanted = MissionEntry{path, "template", *name}.text();
  const TomlValue* templates = document.find("template");
  const TomlValue* found = templates && templates->kind == TomlValue::Kind::table ? templates->find(wanted) : nullptr;
  if (!found || found->kind != TomlValue::Kind::table)
    fail_in_file(path, name->line, "template = '", wanted, "': there is no table [template.", wanted, "]");

  TomlValue whole = table;
  std::erase(whole.keys, "template");
  whole.items.clear();
  for (const std::string& key : whole.keys) whole.items.push_back(*table.find(key));
  for (std::size_t k = 0; k < found->keys.size(); ++k)
    if (!table.find(found->keys[k])) {
      whole.keys.push_back(found->keys[k]);
      whole.items.push_back(found->items[k]);
    }
  return whole;
}

}  // namespace insonify
