/* How a library made with the unit kit describes itself: what it exports beside the FMI 3.0 table
 * and those of <stride/idle.h> and <stride/describe.h>. */
#ifndef STRIDE_SELF_DESCRIPTION_H
#define STRIDE_SELF_DESCRIPTION_H

#ifdef __cplusplus
extern "C" {
#endif

/* The text of modelDescription.xml for the unit with these resources (a folder, or NULL if there is
 * none). On failure NULL, and *error holds the reason. Both texts live in the library until the
 * next call from the same thread. */
typedef const char* strideModelDescriptionTYPE(const char* resourcePath, const char** error);

/* Likewise the text of extra/org.stride.idle/fmi-ls-manifest.xml; empty for a unit that never
 * promises to be idle, which has no such file. */
typedef const char* strideIdleManifestTYPE(const char* resourcePath, const char** error);

#ifdef __cplusplus
}
#endif

#endif
