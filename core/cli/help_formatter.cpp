#include "core/cli/help_formatter.h"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace fluxwalk::cli {

namespace {

constexpr std::size_t kColumns = 100;
constexpr std::size_t kNameColumns = 26;

}  // namespace

std::vector<std::string> wrapText(std::string_view text, std::size_t columns) {
    std::vector<std::string> lines;
    std::string line;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (word.empty()) {
            continue;
        }
        if (!line.empty() && line.size() + 1 + word.size() > columns) {
            lines.push_back(std::move(line));
            line.clear();
        }
        line += line.empty() ? "" : " ";
        line += word;
    }
    if (!line.empty()) {
        lines.push_back(std::move(line));
    }
    return lines;
}

HelpFormatter::HelpFormatter() {
    column_width(kNameColumns);
    label("SUBCOMMAND", "COMMAND");
    label("Positionals", "Arguments");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    // One empty line between parts is enough.
    for (std::size_t i = text.find("\n\n\n"); i != std::string::npos; i = text.find("\n\n\n", i)) {
        text.erase(i, 1);
    }
    while (text.ends_with("\n\n")) {
        text.pop_back();
    }
    return text;
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool isPositional) const {
    std::string name = "  " + option->get_name(isPositional, !isPositional);
    for (std::size_t comma = name.find(','); comma != std::string::npos; comma = name.find(',', comma + 2)) {
        name.insert(comma + 1, " ");
    }
    if (!isPositional && option->get_type_size() != 0 && !option->get_type_name().empty()) {
        name += " " + option->get_type_name();
    }
    std::string text;
    for (const std::string& line : wrapText(option->get_description(), kColumns - kNameColumns)) {
        if (text.empty() && name.size() + 2 <= kNameColumns) {
            text = name + std::string(kNameColumns - name.size(), ' ');
        } else {
            text += text.empty() ? name + "\n" : "";
            text += std::string(kNameColumns, ' ');
        }
        text += line + "\n";
    }
    return text.empty() ? name + "\n" : text;
}

std::string HelpFormatter::make_footer(const CLI::App* app) const {
    const std::string footer = app->get_footer();
    return footer.empty() ? footer : "\n" + footer + "\n";
}

}  // namespace fluxwalk::cli
