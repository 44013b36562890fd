# XXH3 comes from the header alone.
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED DOC "Folder of xxhash.h (Debian: libxxhash-dev)")
target_include_directories(sky_model SYSTEM PRIVATE ${XXHASH_INCLUDE_DIR})
