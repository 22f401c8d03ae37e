#pragma once

#include "table.hpp"

#include <rota/adapters/alica/model.hpp>
#include <rota/model/allocation.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rota::cli {

using vocabulary = runtime_vocabulary;

/// The plans that the command line asks about: one plan, or the activated plans of a plan type.
struct target {
  alica::model model;
  std::vector<alica::plan const*> plans;   ///< into `model`
  alica::plan_type const* type = nullptr;  ///< into `model`; none: `plans` is one plan

  target() = default;
  target(target const&) = delete;
  target& operator=(target const&) = delete;

  [[nodiscard]] alica::plan const& plan(vocabulary::plan p) const;
  /// The plan's name; with its id if the name is empty, or another plan of the type has it too.
  [[nodiscard]] std::string name(alica::plan const& p) const;
  /// The task's name within the plan.
  [[nodiscard]] std::string name(alica::plan const& p, vocabulary::task t) const;
  [[nodiscard]] std::optional<vocabulary::task> find_task(alica::plan const& p, std::string const& label) const;
};

/// Loads the files and finds the plan type of this name or id. Without a name it takes the only plan type, if a file of it was
/// given or there is no plan; else the only plan. Files given by name must have no errors. Throws `input_error`.
[[nodiscard]] std::unique_ptr<target const> find_target(std::vector<std::string> const& files,
                                                        std::string const& plan_type);

/// Agents by name. Their ids ascend with their names, so that nothing depends on the order of rows.
class roster {
public:
  /// The agents of the table, and those that only an old allocation names.
  roster(std::vector<std::string> const& present, std::vector<std::string> const& departed);

  [[nodiscard]] std::vector<vocabulary::agent> const& present() const { return present_; }
  [[nodiscard]] vocabulary::agent id(std::string const& name) const { return ids_.at(name); }
  [[nodiscard]] std::string const& name(vocabulary::agent a) const { return *names_.at(a); }

private:
  std::map<std::string, vocabulary::agent> ids_;
  std::map<vocabulary::agent, std::string const*> names_;
  std::vector<vocabulary::agent> present_;
};

/// Additive utilities, or costs, of the target's plans, read from a table by the names of agents and tasks.
class utilities {
public:
  /// Throws `input_error` for a column that names no task of the target. Views nothing.
  utilities(utility_table table, target const& t, std::string const& file);

  [[nodiscard]] std::optional<double> operator()(std::string const& agent, vocabulary::plan p,
                                                 vocabulary::task t) const;
  [[nodiscard]] std::vector<std::string> const& agents() const { return table_.agents; }
  [[nodiscard]] utility_table const& table() const { return table_; }

private:
  utility_table table_;
  std::map<std::string, std::size_t> rows_;
  std::map<std::pair<vocabulary::plan, vocabulary::task>, std::size_t> columns_;
};

}  // namespace rota::cli
