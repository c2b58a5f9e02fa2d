// Vulkan loaders and drivers keep what they allocate until the process ends; that is not for us to mend. The sanitizer
// finds what is visible alone, and asks nobody in a build without it.
extern "C" [[gnu::visibility("default")]] const char* __asan_default_options();

const char* __asan_default_options() { return "detect_leaks=0"; }
