/// Read by LeakSanitizer. OSMesa keeps the framebuffers of its contexts when these are destroyed; its frames
/// are the library's own, and nothing of ours is on their stacks.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier): its name

extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier): its name
    return "leak:libOSMesa.so.8\n";
}
