# Compile options that every target of the project shares: warnings, and float arithmetic that is never contracted or
# reordered, since results are compared byte by byte (docs/architecture.md, "One result everywhere").
add_library(quorum_options INTERFACE)
target_compile_features(quorum_options INTERFACE cxx_std_23)
target_compile_options(quorum_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(QUORUM_SANITIZE)
  target_compile_options(quorum_options INTERFACE
    -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(quorum_options INTERFACE -fsanitize=address,undefined)
endif()
if(QUORUM_WERROR)
  target_compile_options(quorum_options INTERFACE -Werror)
endif()
