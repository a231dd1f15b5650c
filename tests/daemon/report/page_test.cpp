#include "daemon/report/page.h"

#include <catch2/catch.hpp>

using namespace gyrocal::report;

TEST_CASE("a page holds everything itself and runs nothing", "[report]") {
  Page page("a < b & \"c\"");
  page.banner("pass", "all <good>");
  page.table({"name", "value"}, {{"<script>", "1.5"}, {"x", "-2"}});
  page.list({"one", "two"});
  const std::string html = page.finish();
  CHECK(html.starts_with("<!doctype html>"));
  CHECK(html.find("<title>a &lt; b &amp; &quot;c&quot;</title>") != std::string::npos);
  CHECK(html.find("<script") == std::string::npos);
  CHECK(html.find("http") == std::string::npos);
  CHECK(html.find("<td class=\"number\">1.5</td>") != std::string::npos);
  CHECK(html.find("<td>&lt;script&gt;</td>") != std::string::npos);
}
