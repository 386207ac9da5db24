#include "viewer/ui/option_widget.h"

#include <algorithm>
#include <array>
#include <string>

#include <imgui.h>

#include "core/base/check.h"
#include "core/solve/options_table.h"
#include "viewer/ui/widgets.h"

namespace fluxwalk::ui {
namespace {

/// Sliders are logarithmic and need ends that a hand can tell apart.
struct Ends {
    double least;
    double most;
};

Ends endsOf(const solve::OptionInfo& option) {
    constexpr double kLeastPart = 1e-9;
    constexpr double kMostValue = 1e4;
    // Finer than the finest error takes hours, coarser than the coarsest nothing.
    constexpr Ends kFractions{1e-3, 0.5};
    if (option.kind == solve::OptionKind::fraction) {
        return {std::max(option.minimum, kFractions.least), std::min(option.maximum, kFractions.most)};
    }
    const double most = std::min(option.maximum, kMostValue);
    return {option.minimum > 0.0 ? option.minimum : std::max(kLeastPart, 1e-8 * most), most};
}

std::string formatFor(const solve::OptionInfo& option) {
    if (option.kind == solve::OptionKind::fraction) {
        return "%.3g %%";
    }
    // As the rest of the panel writes them; the table's are typed.
    constexpr std::array<std::pair<std::string_view, const char*>, 3> kWritten{
        {{"degrees", "%.4g\u00b0"}, {"lux", "%.4g lx"}, {"m2", "%.4g m\u00b2"}}};
    for (const auto& [unit, format] : kWritten) {
        if (option.unit == unit) {
            return format;
        }
    }
    return option.unit.empty() ? "%.4g" : "%.4g " + std::string(option.unit);
}

std::string explainOption(const solve::OptionInfo& option) {
    std::string text(option.explanation);
    const std::string range = solve::describeRange(option);
    if (!range.empty()) {
        text += "\n\nRange: " + range + ".";
    }
    return text + "\nDefault: " + solve::formatOption(option, option.defaultValue()) + ".";
}

bool drawChoice(const solve::OptionInfo& option, solve::Options& options) {
    const auto chosen = static_cast<std::size_t>(option.get(options));
    bool isChanged = false;
    if (ImGui::BeginCombo("##choice", std::string(option.choices[chosen]).c_str())) {
        for (std::size_t i = 0; i < option.choices.size(); ++i) {
            if (ImGui::Selectable(std::string(option.choices[i]).c_str(), i == chosen) && i != chosen) {
                option.set(options, static_cast<double>(i));
                isChanged = true;
            }
        }
        ImGui::EndCombo();
    }
    return isChanged;
}

bool drawNumber(const solve::OptionInfo& option, solve::Options& options, double present) {
    const bool isFraction = option.kind == solve::OptionKind::fraction;
    const double unit = isFraction ? 0.01 : 1.0;
    double value = option.get(options) / unit;
    const Ends ends = endsOf(option);
    const bool hasZero = !option.zero.empty();
    bool isChanged = false;
    if (hasZero) {
        bool isZero = value == 0.0;
        if (ImGui::Checkbox(std::string(option.zero).c_str(), &isZero)) {
            const double start = present > 0.0                 ? present
                                 : option.defaultValue() > 0.0 ? option.defaultValue()
                                                               : 1.0;
            value = isZero ? 0.0 : std::clamp(start, ends.least, ends.most);
            isChanged = true;
        }
        if (!isZero) {
            beginRow("", "");
        }
    }
    if (!hasZero || value != 0.0) {
        isChanged |= slideLogarithmic("##value", value, ends.least / unit, ends.most / unit,
                                      formatFor(option).c_str());
    }
    if (isChanged) {
        option.set(options, value * unit);
    }
    return isChanged;
}

}  // namespace

bool drawOption(std::string_view name, const char* label, solve::Options& options, double present) {
    const solve::OptionInfo* option = solve::findOption(name);
    FLUXWALK_CHECK(option != nullptr);
    ImGui::PushID(label);
    beginRow(label, explainOption(*option).c_str());
    bool isChanged = false;
    switch (option->kind) {
        case solve::OptionKind::choice:
            isChanged = drawChoice(*option, options);
            break;
        case solve::OptionKind::flag: {
            bool isOn = option->get(options) != 0.0;
            isChanged = ImGui::Checkbox("##flag", &isOn);
            if (isChanged) {
                option->set(options, isOn ? 1.0 : 0.0);
            }
            break;
        }
        default:
            isChanged = drawNumber(*option, options, present);
            break;
    }
    ImGui::PopID();
    return isChanged;
}

}  // namespace fluxwalk::ui
