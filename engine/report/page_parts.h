// The texts of the page, embedded by cmake/ReportPage.cmake.
#pragma once

#include <string_view>

namespace quorum {

extern const std::string_view kPageHtml;      ///< with <!--style-->, <!--data--> and <!--script--> in their places
extern const std::string_view kPageStyle;     ///< engine/report/page/report.css
extern const std::string_view kPageScript;    ///< engine/report/page/report.js
extern const std::string_view kPageThree;     ///< three.js, as Debian packages it
extern const std::string_view kPageControls;  ///< its TrackballControls

}  // namespace quorum
