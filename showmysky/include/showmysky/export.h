/* What the shared library lets others see. */
#ifndef SHOWMYSKY_EXPORT_H
#define SHOWMYSKY_EXPORT_H

#if defined(_WIN32) && !defined(SHOWMYSKY_STATIC)
#ifdef SHOWMYSKY_BUILDING
#define SHOWMYSKY_API __declspec(dllexport)
#else
#define SHOWMYSKY_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define SHOWMYSKY_API __attribute__((visibility("default")))
#else
#define SHOWMYSKY_API
#endif

#endif
