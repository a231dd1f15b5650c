#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gyrocal::report {

/// Text made safe for HTML.
[[nodiscard]] std::string escaped(std::string_view text);

/// One self-contained HTML file, written from top to bottom: no script, nothing fetched, prints
/// well, dark where the reader's machine is.
class Page {
 public:
  explicit Page(std::string_view title);

  void heading(std::string_view text);
  void paragraph(std::string_view text);
  /// A verdict that must catch the eye.
  void banner(std::string_view word, std::string_view sentence);
  /// @param rows  each as long as `header`. Columns whose every cell is a number stand to the
  /// right.
  void table(const std::vector<std::string>& header,
             const std::vector<std::vector<std::string>>& rows);
  /// @param svg  as svg_of() gives it.
  void figure(std::string_view svg, std::string_view caption);
  void list(const std::vector<std::string>& items);

  /// The whole file.
  [[nodiscard]] std::string finish() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace gyrocal::report
