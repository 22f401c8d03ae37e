#include "sweep.hpp"
#include "command.hpp"
#include "json.hpp"
#include "playing.hpp"
#include "report.hpp"
#include "text.hpp"

#include <rota/sim/stamp_policy.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

namespace rota::cli {
namespace {

using strings = std::vector<std::string>;

/// The tables that docs/evaluation.md quotes: what they vary.
struct named_table {
  char const* name;
  strings systems, troubles;
  strings reigns{}, stamps{}, news{};
  std::vector<double> losses{}, reign_lengths{}, hystereses{}, change_costs{};
  std::vector<std::uint64_t> robots{};
  std::vector<std::int64_t> periods{};
  std::vector<std::uint32_t> cycles{};
};
strings const every_system{"rota", "silent", "alica", "central", "majority", "steam", "consa", "cbba"};
strings const calm_or_deluded{"none", "delusion"};

std::vector<named_table> const& named_tables() {
  std::string const best{to_string(sim::best_stamp_policy)};
  strings stamps;
  for (auto const p : sim::all_stamp_policies) stamps.emplace_back(to_string(p));
  strings const rota{"rota"}, three{"none", "delusion", "mixed"};
  static std::vector<named_table> const all{
      {.name = "beside", .systems = every_system, .troubles = {"none", "delusion", "mixed", "breakdowns"}},
      {.name = "loss", .systems = every_system, .troubles = calm_or_deluded, .losses = {0, 0.2, 0.6}},
      {.name = "rate", .systems = every_system, .troubles = calm_or_deluded, .periods = {100, 200, 500}},
      {.name = "team", .systems = every_system, .troubles = calm_or_deluded, .robots = {3, 4, 5}},
      {.name = "cycles", .systems = rota, .troubles = three, .cycles = {2, 3, 4, 5, 6}},
      {.name = "reign",
       .systems = rota,
       .troubles = three,
       .reigns = {"fixed", "renewed"},
       .stamps = {"id", best},
       .losses = {0.02, 0.6}},
      {.name = "length",
       .systems = rota,
       .troubles = calm_or_deluded,
       .reigns = {"fixed", "renewed"},
       .reign_lengths = {0.5, 2, 8}},
      {.name = "stamp", .systems = rota, .troubles = three, .stamps = stamps},
      {.name = "news", .systems = rota, .troubles = calm_or_deluded, .news = {"on", "off"}, .periods = {50, 100, 200}},
      {.name = "hysteresis", .systems = rota, .troubles = calm_or_deluded, .hystereses = {0, 0.05, 0.1, 0.2, 0.5, 1}},
      {.name = "change-cost",
       .systems = rota,
       .troubles = calm_or_deluded,
       .hystereses = {0, 0.1},
       .change_costs = {0, 0.1, 0.5}}};
  return all;
}

template <class T>
std::vector<T> given_or(std::vector<T> const& given, std::vector<T> const& table, std::vector<T> const& usual) {
  auto const& chosen = !given.empty() ? given : !table.empty() ? table : usual;
  std::vector<T> out;
  for (T const& x : chosen)
    if (std::find(out.begin(), out.end(), x) == out.end()) out.push_back(x);
  return out;
}

/// Every setting, in the order in which tables print them.
std::vector<sweep_cell> cells_of(sweep_options const& o, double hysteresis) {
  named_table none{};
  auto const* t = &none;
  for (auto const& x : named_tables())
    if (o.table == x.name) t = &x;
  std::vector<sweep_cell> cells(1);
  cells.front().minutes = o.minutes;
  // Each setting so far once with each of these values; `rota` says that only rota's robots have it.
  auto const cross = [&](auto sweep_cell::* member, auto const& values, bool rota = false) {
    std::vector<sweep_cell> more;
    constexpr std::size_t most = 100'000;
    if (cells.size() > most / o.seeds / values.size())
      throw input_error("the sweep has more than " + std::to_string(most) + " games: name fewer values or seeds");
    for (auto const& c : cells)
      for (auto const& x : values) {
        auto& next = more.emplace_back(c);
        if (!rota || c.system == "rota") next.*member = x;
        if (rota && c.system != "rota") break;
      }
    cells = std::move(more);
  };
  robot_options const usual;
  cross(&sweep_cell::trouble, given_or<std::string>(o.troubles, t->troubles, {"none", "delusion"}));
  cross(&sweep_cell::robots, given_or<std::uint64_t>(o.robots, t->robots, {5}));
  cross(&sweep_cell::loss, given_or<double>(o.losses, t->losses, {0.02}));
  cross(&sweep_cell::period_ms, given_or<std::int64_t>(o.periods, t->periods, {100}));
  cross(&sweep_cell::hysteresis, given_or<double>(o.hystereses, t->hystereses, {hysteresis}));
  cross(&sweep_cell::reign, strings{"-"});
  cross(&sweep_cell::stamp, strings{"-"});
  cross(&sweep_cell::news, strings{"-"});
  cross(&sweep_cell::system, given_or<std::string>(o.systems, t->systems, every_system));
  cross(&sweep_cell::cycles, given_or<std::uint32_t>(o.cycles, t->cycles, {usual.cycles}), true);
  cross(&sweep_cell::reign, given_or<std::string>(o.reigns, t->reigns, {"renewed"}), true);
  cross(&sweep_cell::reign_s,
        given_or<double>(o.reign_lengths, t->reign_lengths, {static_cast<double>(usual.reign.ns) / 1e9}), true);
  cross(&sweep_cell::stamp,
        given_or<std::string>(o.stamps, t->stamps, {std::string(to_string(sim::best_stamp_policy))}), true);
  cross(&sweep_cell::news, given_or<std::string>(o.news, t->news, {"on"}), true);
  cross(&sweep_cell::change_cost, given_or<double>(o.change_costs, t->change_costs, {usual.change_cost}), true);
  return cells;
}

/// Calls `work(i)` for i below `count` on so many threads, and `done(i)` here, in order. An exception ends everything.
void in_parallel(std::size_t count, std::size_t threads, std::function<void(std::size_t)> const& work,
                 std::function<void(std::size_t)> const& done) {
  std::mutex lock;
  std::condition_variable changed;
  std::vector<bool> finished(count);
  std::exception_ptr failure;
  std::atomic<std::size_t> next{0};
  auto const run = [&] {
    for (std::size_t i; (i = next++) < count;) {
      std::exception_ptr error;
      try {
        work(i);
      } catch (...) {
        error = std::current_exception();
        next = count;
      }
      std::lock_guard const held(lock);
      finished[i] = true;
      if (error) failure = error;
      changed.notify_one();
    }
  };
  std::vector<std::thread> crew;
  struct joiner {
    std::vector<std::thread>& crew;
    std::atomic<std::size_t>& next;
    std::size_t count;
    ~joiner() {
      next = count;
      for (auto& t : crew) t.join();
    }
  } const at_the_end{crew, next, count};
  for (std::size_t k = 0; k < (std::min)(threads, count); ++k) crew.emplace_back(run);
  for (std::size_t i = 0; i < count; ++i) {
    {
      std::unique_lock held(lock);
      changed.wait(held, [&] { return finished[i] || failure; });
      if (failure) std::rethrow_exception(failure);
    }
    done(i);
  }
}

/// Names the game of a row, whatever came of it.
std::string game_of(sweep_row row) {
  row.figures = {};
  return as_line(row);
}

std::string places(double x, double unit) {
  return number(static_cast<double>(static_cast<std::int64_t>(x * unit + (x < 0 ? -0.5 : 0.5))) / unit);
}

/// "12.3 ±0.4", in this unit, with as many places as make sense.
std::string shown(estimate const& e, double unit, bool interval) {
  if (e.games == 0) return "-";
  double const x = e.mean * unit, w = e.within.value_or(0) * unit;
  double const digits = std::abs(x) >= 100 ? 1 : std::abs(x) >= 10 ? 10 : 100;
  return places(x, digits) + (interval && e.within ? " ±" + places(w, digits) : "");
}

/// The columns of a cell that differ between lines, besides the system.
struct axis {
  char const* name;
  std::string (*text)(sweep_cell const&);
  std::string (*words)(sweep_cell const&);
};
constexpr axis axes[] = {
    {"robots", [](sweep_cell const& c) { return std::to_string(c.robots); },
     [](sweep_cell const& c) { return counted(c.robots, "robot"); }},
    {"loss", [](sweep_cell const& c) { return percent(c.loss); },
     [](sweep_cell const& c) { return percent(c.loss) + " loss"; }},
    {"every", [](sweep_cell const& c) { return std::to_string(c.period_ms) + " ms"; },
     [](sweep_cell const& c) { return "messages every " + std::to_string(c.period_ms) + " ms"; }},
    {"n", [](sweep_cell const& c) { return c.cycles == 0 ? "-" : std::to_string(c.cycles); },
     [](sweep_cell const& c) { return c.cycles == 0 ? "" : "n = " + std::to_string(c.cycles); }},
    {"reign", [](sweep_cell const& c) { return c.reign; },
     [](sweep_cell const& c) { return c.reign == "-" ? "" : "reigns " + c.reign; }},
    {"for", [](sweep_cell const& c) { return c.reign == "-" ? "-" : number(c.reign_s) + " s"; },
     [](sweep_cell const& c) { return c.reign == "-" ? "" : "for " + number(c.reign_s) + " s"; }},
    {"stamp", [](sweep_cell const& c) { return c.stamp; },
     [](sweep_cell const& c) { return c.stamp == "-" ? "" : "stamp " + c.stamp; }},
    {"news", [](sweep_cell const& c) { return c.news; },
     [](sweep_cell const& c) { return c.news == "-" ? "" : "news " + c.news; }},
    {"hysteresis", [](sweep_cell const& c) { return number(c.hysteresis) + " m"; },
     [](sweep_cell const& c) { return "hysteresis " + number(c.hysteresis) + " m"; }},
    {"change cost", [](sweep_cell const& c) { return c.news == "-" ? "-" : number(c.change_cost) + " m"; },
     [](sweep_cell const& c) { return c.news == "-" ? "" : "change cost " + number(c.change_cost) + " m"; }}};

/// Whether lines to which this applies differ in it.
bool varies(sweep_table const& t, axis const& a) {
  std::string first;
  for (auto const& l : t.lines) {
    auto const words = a.words(l.cell);
    if (words.empty()) continue;
    if (first.empty()) first = words;
    if (words != first) return true;
  }
  return false;
}

std::string as_text(sweep_table const& t) {
  struct column {
    char const* name;
    quantity what;
    double unit;
    bool interval;
  };
  constexpr column columns[] = {
      {"not right %", quantity::not_right, 100, true}, {"not one %", quantity::not_one, 100, true},
      {"wrong %", quantity::wrong, 100, true},         {"conflict %", quantity::conflict, 100, true},
      {"median", quantity::median, 1, false},          {"p99", quantity::p99, 1, false},
      {"reaction", quantity::reaction, 1, true},       {"p95", quantity::reaction_p95, 1, false},
      {"missed %", quantity::missed, 100, true},       {"to the ball", quantity::to_ball, 0.001, true},
      {"reigns", quantity::reigns, 1, false},          {"right %", quantity::right, 100, false},
      {"sent", quantity::messages, 1, false},          {"bytes", quantity::bytes, 1, false}};
  std::vector<std::array<std::string, 2 + std::size(axes) + quantities>> rows;
  auto const add = [&](auto const& fill) {
    auto& row = rows.emplace_back();
    std::size_t at = 0;
    fill(row, at);
  };
  std::vector<axis const*> shown_axes;
  std::string fixed;
  for (auto const& a : axes) {
    if (varies(t, a)) {
      shown_axes.push_back(&a);
    } else {
      for (auto const& l : t.lines)
        if (auto const words = a.words(l.cell); !words.empty()) {
          fixed += "; " + words;
          break;
        }
    }
  }
  add([&](auto& row, std::size_t& at) {
    row[at++] = "trouble";
    row[at++] = "system";
    for (auto const* a : shown_axes) row[at++] = a->name;
    for (auto const& c : columns) row[at++] = c.name;
  });
  std::string last;
  for (auto const& l : t.lines)
    add([&](auto& row, std::size_t& at) {
      row[at++] = l.cell.trouble == last ? "" : l.cell.trouble;
      last = l.cell.trouble;
      row[at++] = l.cell.system;
      for (auto const* a : shown_axes) row[at++] = a->text(l.cell);
      for (auto const& c : columns) row[at++] = shown(l.figures[static_cast<std::size_t>(c.what)], c.unit, c.interval);
    });
  auto const minutes = t.lines.empty() ? 0 : t.lines.front().cell.minutes;
  return "A closed world, " + t.plan + ": " + fixed.substr(fixed.empty() ? 0 : 2) + "; " + counted(t.seeds, "game") +
         " of " + number(minutes) + " minutes a line, seeds from " + std::to_string(t.seed) + ".\n\n" + laid_out(rows) +
         "\n  A mean ± half of its 95 % interval; --json has all intervals. not one: time without exactly one "
         "attacker. "
         "wrong: with\n  one, and another is nearer to the ball by more than 50 cm. not right: either. conflict: two "
         "believe "
         "in different\n  allocations; median, p99: ms until it is resolved. reaction, p95: ms until the robot that is "
         "nearest "
         "after a kick\n  attacks; missed: it did not in time. to the ball: s that a ball lies free, for each that is "
         "reached. "
         "reigns: an hour;\n  right: those in which the right one attacks. sent, bytes: messages and bytes a second "
         "and robot.\n";
}

}  // namespace

estimate estimated(std::vector<double> const& values) {
  estimate e;
  e.games = values.size();
  if (values.empty()) return e;
  double const n = static_cast<double>(values.size());
  for (double const x : values) e.mean += x / n;
  if (values.size() < 2) return e;
  double squares = 0;
  for (double const x : values) squares += (x - e.mean) * (x - e.mean);
  constexpr double t95[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                            2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
                            2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
  auto const freedom = values.size() - 1;
  e.within = (freedom <= std::size(t95) ? t95[freedom - 1] : 1.96) * std::sqrt(squares / (n - 1) / n);
  return e;
}

std::string_view name_of(quantity m) {
  constexpr std::string_view names[quantities] = {
      "not_one_attacker_share", "wrong_attacker_share", "conflict_share",  "resolution_median_ms",
      "resolution_p99_ms",      "reaction_mean_ms",     "reaction_p95_ms", "missed_share",
      "time_to_ball_ms",        "reigns_per_hour",      "right_share",     "messages_per_second",
      "bytes_per_second",       "not_right_share"};
  return names[static_cast<std::size_t>(m)];
}

std::string differences(sweep_table const& t, sweep_cell const& cell) {
  std::string out;
  for (auto const& a : axes)
    if (varies(t, a))
      if (auto const words = a.words(cell); !words.empty()) out += (out.empty() ? "" : ", ") + words;
  return out;
}

std::vector<std::string> sweep_table_names() {
  std::vector<std::string> out;
  for (auto const& t : named_tables()) out.push_back(t.name);
  return out;
}

outcome run_sweep(sweep_options const& o) {
  auto const file = default_plan();
  auto const book = read_playbook(file);
  auto const cells = cells_of(o, book.plans.front().hysteresis);
  for (auto const& c : cells) require_playable(book, c.robots, file);

  std::vector<sweep_row> rows;
  for (auto const& c : cells)
    for (std::uint64_t k = 0; k < o.seeds; ++k) rows.push_back({c, o.seed + k, plan_names(book), ROTA_VERSION, {}});
  std::vector<std::size_t> open;
  std::optional<row_file> kept;
  if (!o.rows.empty()) kept.emplace(o.rows);
  std::map<std::string, sweep_row const*> known;
  if (kept)
    for (auto const& r : kept->rows()) known.emplace(game_of(r), &r);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto const at = known.find(game_of(rows[i]));
    if (at == known.end()) {
      open.push_back(i);
    } else {
      rows[i].figures = at->second->figures;
    }
  }
  known.clear();  // appending moves the rows
  {
    progress shown_games;
    auto const threads = o.jobs > 0 ? o.jobs : (std::max)(std::thread::hardware_concurrency(), 1u);
    in_parallel(
        open.size(), threads,
        [&](std::size_t k) {
          auto& row = rows[open[k]];
          row.figures = play_cell(book, row.cell, row.seed);
        },
        [&](std::size_t k) {
          auto const& row = rows[open[k]];
          if (kept) kept->append(row);
          shown_games.next(open.size(),
                           row.cell.system + ", " + row.cell.trouble + ", seed " + std::to_string(row.seed));
        });
  }

  sweep_table t{o.table, o.seed, o.seeds, plan_names(book), {}};
  for (auto& r : rows) {
    auto const of = [&](quantity q) -> auto& { return r.figures[static_cast<std::size_t>(q)]; };
    if (of(quantity::not_one) && of(quantity::wrong))
      of(quantity::not_right) = *of(quantity::not_one) + *of(quantity::wrong);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    auto& line = t.lines.emplace_back(sweep_line{cells[c], {}});
    for (std::size_t m = 0; m < quantities; ++m) {
      std::vector<double> values;
      for (std::size_t k = 0; k < o.seeds; ++k)
        if (auto const& x = rows[c * o.seeds + k].figures[m]) values.push_back(*x);
      line.figures[m] = estimated(values);
    }
  }
  if (!o.chart.empty()) write_whole(o.chart, as_chart(t));
  return {o.json ? as_json(t) : as_text(t)};
}

}  // namespace rota::cli
