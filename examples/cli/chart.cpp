#include "sweep.hpp"
#include "text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rota::cli {
namespace {

/// A scale of powers of ten.
struct scale {
  double low, high;  // of the values
  double from, to;   // on the paper
  [[nodiscard]] double at(double x) const {
    auto const part = std::log10(std::clamp(x, low, high) / low) / std::log10(high / low);
    return from + part * (to - from);
  }
};

std::string whole(double x) {
  return number(static_cast<double>(static_cast<long long>(x * 10 + (x < 0 ? -0.5 : 0.5))) / 10);
}

std::string escaped(std::string const& s) {
  std::string out;
  for (char const c : s) out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return out;
}

std::string text(double x, double y, std::string const& what, std::string const& more = "") {
  return "<text x=\"" + whole(x) + "\" y=\"" + whole(y) + "\"" + more + ">" + escaped(what) + "</text>\n";
}
std::string line(double x, double y, double x2, double y2, std::string const& colour) {
  return "<line x1=\"" + whole(x) + "\" y1=\"" + whole(y) + "\" x2=\"" + whole(x2) + "\" y2=\"" + whole(y2) +
         "\" stroke=\"" + colour + "\"/>\n";
}

constexpr double panel_width = 430, panel_height = 420, margin_left = 60, margin_top = 50, margin_bottom = 60;

std::string panel(sweep_table const& t, std::string const& trouble) {
  double slowest = 0;
  for (auto const& l : t.lines)
    if (l.cell.trouble == trouble)
      slowest = (std::max)(slowest, l.figures[static_cast<std::size_t>(quantity::reaction)].mean);
  double most = 100;
  while (most < slowest) most *= 10;
  scale const across{10, most, margin_left, panel_width - 20};
  scale const up{1e-4, 1, panel_height - margin_bottom, margin_top};
  std::string out = text(margin_left, margin_top - 14, "trouble: " + trouble, " font-weight=\"bold\"");
  for (double const ms : {10, 20, 30, 50, 100, 200, 500, 1000, 10'000, 100'000}) {
    bool const round = ms == 10 || ms == 100 || ms >= 1000;
    if (ms > most || (most > 1000 && !round) || (most > 100 && ms == 30)) continue;
    out += line(across.at(ms), up.from, across.at(ms), up.to, "#e4e4e4");
    out += text(across.at(ms), up.from + 16, number(ms), " text-anchor=\"middle\"");
  }
  for (double const share : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    out += line(across.from, up.at(share), across.to, up.at(share), "#e4e4e4");
    out += text(across.from - 6, up.at(share) + 4, number(share * 100) + " %", " text-anchor=\"end\"");
  }
  out += text((across.from + across.to) / 2, panel_height - 22, "mean reaction to a true change of the ball, ms",
              " text-anchor=\"middle\"");
  std::vector<std::pair<double, double>> labels;
  for (auto const& l : t.lines) {
    if (l.cell.trouble != trouble) continue;
    auto const of = [&](quantity m) { return l.figures[static_cast<std::size_t>(m)]; };
    auto const reaction = of(quantity::reaction), apart = of(quantity::not_one), wrong = of(quantity::wrong);
    if (reaction.games == 0) continue;
    bool const ours = l.cell.system == "rota";
    std::string const colour = ours ? "#c0392b" : "#34495e";
    double const x = across.at(reaction.mean), y = up.at(apart.mean), y2 = up.at(apart.mean + wrong.mean);
    out += line(x, y, x, y2, colour);
    auto const spread = [&](estimate const& e, double unit) { return e.within.value_or(0) * unit; };
    out += line(across.at(reaction.mean - spread(reaction, 1)), y, across.at(reaction.mean + spread(reaction, 1)), y,
                colour);
    out += "<circle cx=\"" + whole(x) + "\" cy=\"" + whole(y) + "\" r=\"4\" fill=\"" + colour + "\"/>\n";
    out +=
        "<circle cx=\"" + whole(x) + "\" cy=\"" + whole(y2) + "\" r=\"4\" fill=\"white\" stroke=\"" + colour + "\"/>\n";
    auto label = l.cell.system;
    if (auto const more = differences(t, l.cell); !more.empty()) label += " (" + more + ")";
    double below = y + 4;
    for (bool moved = true; moved;) {  // labels do not cover each other
      moved = false;
      for (auto const& [lx, ly] : labels)
        if (std::abs(lx - x) < 60 && std::abs(ly - below) < 11) below = ly + 12, moved = true;
    }
    labels.emplace_back(x, below);
    out += text(x + 8, below, label, " fill=\"" + colour + "\"");
  }
  return out;
}

}  // namespace

std::string as_chart(sweep_table const& t) {
  std::vector<std::string> troubles;
  for (auto const& l : t.lines)
    if (std::find(troubles.begin(), troubles.end(), l.cell.trouble) == troubles.end())
      troubles.push_back(l.cell.trouble);
  auto const columns = (std::min<std::size_t>)(troubles.size(), 2);
  auto const rows = (troubles.size() + 1) / 2;
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + whole(panel_width * static_cast<double>(columns)) +
      " " + whole(panel_height * static_cast<double>(rows) + 20) +
      "\" font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n" +
      text(margin_left, 18, "full: time without exactly one attacker; hollow: … or with the wrong one; bar: 95 %");
  for (std::size_t i = 0; i < troubles.size(); ++i)
    out += "<g transform=\"translate(" + whole(panel_width * static_cast<double>(i % 2)) + " " +
           whole(20 + panel_height * static_cast<double>(i / 2)) + ")\">\n" + panel(t, troubles[i]) + "</g>\n";
  return out + "</svg>\n";
}

}  // namespace rota::cli
