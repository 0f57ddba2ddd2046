#include "units/mujoco_world/robot/inertia.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <locale>
#include <optional>
#include <set>
#include <sstream>
#include <string>

#include <mujoco/mujoco.h>

#include "units/mujoco_world/hooks.h"
#include "units/mujoco_world/robot/xml_file.h"

namespace mujoco_world {
namespace {

using tinyxml2::XMLElement;
using Moments = std::array<double, 3>;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSmallMass = 1e-3;       // kg
constexpr double kWaterDensity = 1000.0;  // kg/m3, as MuJoCo assumes for geometry
constexpr bool kIsMuJoCo3 = mjVERSION_HEADER >= 300;
constexpr double kLeastMoment = kIsMuJoCo3 ? 1e-14 : mjMINVAL;  // of its compiler, in kg.m2
constexpr double kRounding = 2e-5;  // what six digits, as MuJoCo saves them, can change
constexpr double kMost = 1e100;     // larger numbers could overflow
constexpr std::array<const char*, 6> kElements{"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};

struct Inertial {
  double mass = 0;                  // kg
  std::array<double, 6> inertia{};  // kg.m2, in the order of kElements
};

/// Principal moments, and the axes as the columns of a matrix.
struct Principal {
  Moments moments{};
  std::array<double, 9> axes{};
};

Principal principal_of(const std::array<double, 6>& inertia) {
  const auto [xx, yy, zz, xy, xz, yz] = inertia;
  const std::array<double, 9> matrix{xx, xy, xz, xy, yy, yz, xz, yz, zz};
  Principal principal;
  std::array<double, 4> rotation{};
  mju_eig3(principal.moments.data(), principal.axes.data(), rotation.data(), matrix.data());
  return principal;
}

std::array<double, 6> inertia_of(const Principal& principal) {
  const auto element = [&](std::size_t row, std::size_t column) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      sum += principal.axes[3 * row + i] * principal.moments[i] * principal.axes[3 * column + i];
    }
    return sum;
  };
  return {element(0, 0), element(1, 1), element(2, 2), element(0, 1), element(0, 2), element(1, 2)};
}

/// Of a solid ball: 2/5 m r².
double inertia_of_ball(double mass) {
  return 0.4 * mass * std::pow(3 * mass / (4 * kPi * kWaterDensity), 2.0 / 3.0);
}

/// Whether a moment was below `least`.
bool raise(Moments& moments, double least, double mass) {
  const double greatest = *std::max_element(moments.begin(), moments.end());
  const double ball = inertia_of_ball(std::max(mass, kSmallMass));
  const double enough = greatest >= kLeastMoment ? std::min(ball, greatest) : ball;
  bool raised = false;
  for (double& moment : moments) {
    if (moment >= least) continue;
    moment = enough;
    raised = true;
  }
  return raised;
}

/// Whether one exceeded the sum of the others.
bool balance(Moments& moments) {
  const auto c =
      static_cast<std::size_t>(std::max_element(moments.begin(), moments.end()) - moments.begin());
  const double others = moments[(c + 1) % 3] + moments[(c + 2) % 3];
  if (others >= moments[c]) return false;
  const double third = (moments[c] - others + kRounding * moments[c]) / 3;
  for (double& moment : moments) moment += third;
  moments[c] -= 2 * third;
  return true;
}

std::string six_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string text_of(const std::array<double, 6>& inertia) {
  std::string text;
  for (const double element : inertia) text += (text.empty() ? "" : " ") + six_digits(element);
  return text;
}

/// Repairs it and returns what was repaired, in words; empty if nothing was.
std::string repair(Inertial& inertial, bool needs_mass) {
  const double old_mass = inertial.mass;
  const auto old_inertia = inertial.inertia;
  std::string repaired;
  if (inertial.mass < (needs_mass ? mjMINVAL : 0)) {
    inertial.mass = kSmallMass;
    repaired = ": the mass of " + six_digits(old_mass) + " kg is replaced by " +
               six_digits(inertial.mass) + " kg";
  }
  Principal principal = principal_of(old_inertia);
  // MuJoCo 3 refuses a moment of 0 also where nothing moves, unless all elements are 0
  const bool needs_moments = needs_mass || (kIsMuJoCo3 && old_inertia != Inertial{}.inertia);
  std::string reason;
  if (raise(principal.moments, needs_moments ? kLeastMoment : -mjMINVAL, inertial.mass)) {
    reason = "a principal moment is not above 0";
  }
  if (balance(principal.moments)) reason = "a principal moment exceeds the sum of the others";
  if (reason.empty()) return repaired;
  inertial.inertia = inertia_of(principal);
  return repaired + (repaired.empty() ? ": " : ", and ") +
         "the inertia (ixx iyy izz ixy ixz iyz) of " + text_of(old_inertia) +
         " kg.m2 is replaced by " + text_of(inertial.inertia) + " kg.m2, since " + reason;
}

/// As MuJoCo reads it; nothing if it is not a number, or too large.
std::optional<double> number(const XMLElement& element, const char* name) {
  std::istringstream text(attribute(element, name));
  text.imbue(std::locale::classic());
  double value = 0;
  if (!(text >> value) || !(text >> std::ws).eof() || std::abs(value) > kMost) return std::nullopt;
  return value;
}

/// An element that is absent counts as 0. Nothing if a value cannot be read.
std::optional<Inertial> read(const XMLElement& element) {
  Inertial inertial;
  if (const auto* const mass = element.FirstChildElement("mass")) {
    const auto value = number(*mass, "value");
    if (!value) return std::nullopt;
    inertial.mass = *value;
  }
  const auto* const inertia = element.FirstChildElement("inertia");
  for (std::size_t i = 0; inertia && i < kElements.size(); ++i) {
    const auto value = number(*inertia, kElements[i]);
    if (!value) return std::nullopt;
    inertial.inertia[i] = *value;
  }
  return inertial;
}

void write(XMLElement& link, const Inertial& inertial) {
  XMLElement& element = find_or_make(link, "inertial");
  find_or_make(element, "mass").SetAttribute("value", inertial.mass);
  XMLElement& inertia = find_or_make(element, "inertia");
  for (std::size_t i = 0; i < kElements.size(); ++i) {
    inertia.SetAttribute(kElements[i], inertial.inertia[i]);
  }
}

bool has_mass(const XMLElement& link) {
  const auto* const element = link.FirstChildElement("inertial");
  if (!element) return link.FirstChildElement("collision") != nullptr;
  const auto inertial = read(*element);
  if (!inertial || inertial->mass < mjMINVAL) return false;
  const Moments moments = principal_of(inertial->inertia).moments;
  return *std::min_element(moments.begin(), moments.end()) >= kLeastMoment;
}

/// The links that move against their parents and to which none with mass is fixed.
std::set<std::string> find_links_that_need_mass(const XMLElement& robot) {
  std::set<std::string> heavy, moving, carrying;
  for (const auto* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    if (has_mass(*link)) heavy.insert(attribute(*link, "name"));
  }
  for (const auto* joint = robot.FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    const auto* const parent = joint->FirstChildElement("parent");
    const auto* const child = joint->FirstChildElement("child");
    if (!parent || !child) continue;
    const std::string name = attribute(*child, "link");
    const bool is_fixed = attribute(*joint, "type") == "fixed";
    if (!is_fixed) moving.insert(name);
    if (is_fixed && heavy.count(name) > 0) carrying.insert(attribute(*parent, "link"));
  }
  for (const std::string& link : carrying) moving.erase(link);
  return moving;
}

bool repairs_itself(const XMLElement& robot) {
  const auto* const extension = robot.FirstChildElement("mujoco");
  const auto* const compiler = extension ? extension->FirstChildElement("compiler") : nullptr;
  if (!compiler) return false;
  const auto names = {"boundmass", "boundinertia", "balanceinertia", "inertiafromgeom"};
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return compiler->Attribute(name) != nullptr; });
}

void repair_link(XMLElement& link, bool needs_mass, const std::string& file) {
  const auto* const element = link.FirstChildElement("inertial");
  if (!element && (!needs_mass || has_mass(link))) return;
  const bool is_complete =
      element && element->FirstChildElement("mass") && element->FirstChildElement("inertia");
  auto inertial = element ? read(*element) : Inertial{};
  if (!inertial) return;
  const std::string repaired = repair(*inertial, needs_mass || !is_complete);
  if (repaired.empty()) return;
  write(link, *inertial);
  add_warning(file + ":" + std::to_string(link.GetLineNum()) + ": link '" +
              attribute(link, "name") + "'" + repaired);
}

}  // namespace

void repair_inertias(XMLElement& robot, const std::filesystem::path& file) {
  if (repairs_itself(robot)) return;
  const std::set<std::string> need_mass = find_links_that_need_mass(robot);
  for (auto* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    repair_link(*link, need_mass.count(attribute(*link, "name")) > 0, file.string());
  }
}

}  // namespace mujoco_world
