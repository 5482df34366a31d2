dhpmap_tests(ROOM unit/storage LIBS dhpmap_storage dhpmap_test_scenes)

# Sizes and rates of codec and store on a fused scene; not a test.
dhpmap_program(NAME dhpmap_storage_bench SOURCES unit/storage/storage_bench.cc LIBS dhpmap_storage dhpmap_pipeline dhpmap_test_scenes)
