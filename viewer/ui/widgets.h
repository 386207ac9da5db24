#pragma once

#include <string>

namespace fluxwalk::ui {

/// Begins a foldable part of the panel; returns whether it is open.
bool beginSection(const char* title, bool isOpenAtFirst = true);
/// Writes a label with its explanation and puts the next widget beside it, as wide as the panel allows.
void beginRow(const char* label, const char* explanation);
/// A row that only shows a value, aligned to the right.
void showValue(const char* label, const std::string& value, const char* explanation);
/// Shows `explanation` while the last item is pointed at.
void explain(const char* explanation);
/// Logarithmic slider over a double. Returns whether it changed.
bool slideLogarithmic(const char* id, double& value, double least, double most, const char* format);

}  // namespace fluxwalk::ui
