#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

namespace fluxwalk::cli {

/// Breaks text at spaces into lines of at most `columns` characters; longer words stay whole.
std::vector<std::string> wrapText(std::string_view text, std::size_t columns);

/// Help that can be read: options in one column, what they mean wrapped in the next.
class HelpFormatter : public CLI::Formatter {
  public:
    HelpFormatter();
    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_option(const CLI::Option* option, bool isPositional) const override;
    std::string make_footer(const CLI::App* app) const override;
};

}  // namespace fluxwalk::cli
