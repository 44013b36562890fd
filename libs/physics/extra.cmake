# The colour matching functions are compiled in; loops over wavelengths become vectors.
target_link_libraries(sky_physics PRIVATE sky_data sky_vectors)
