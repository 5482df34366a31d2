# In memory where there is such a folder: most of what these tests wait for is the sync of a busy disk.
if(EXISTS /dev/shm)
  set(storage_test_environment TMPDIR=/dev/shm)
endif()
dhpmap_library(NAME dhpmap_test_map_text SOURCES unit/storage/map_digests.cc unit/storage/map_text.cc PUBLIC dhpmap_storage)
dhpmap_library(NAME dhpmap_test_unsynced_writes SOURCES unit/storage/unsynced_writes.cc)
dhpmap_tests(ROOM unit/storage COST 15 LIBS dhpmap_test_map_text dhpmap_test_postgres_cluster dhpmap_test_unsynced_writes dhpmap_test_scenes dhpmap_test_places ENVIRONMENT ${storage_test_environment})

# Sizes and rates of codec and store on a fused scene or data set; not a test.
dhpmap_program(NAME dhpmap_storage_bench SOURCES unit/storage/storage_bench.cc
  LIBS dhpmap_storage dhpmap_pipeline dhpmap_datasets dhpmap_test_scenes)
set_target_properties(dhpmap_storage_bench PROPERTIES EXCLUDE_FROM_ALL ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)

# What a database holds, as text: for tests/unit/storage/released.
dhpmap_program(NAME dhpmap_map_text SOURCES unit/storage/map_text_main.cc LIBS dhpmap_test_map_text)
set_target_properties(dhpmap_map_text PROPERTIES EXCLUDE_FROM_ALL ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)

# Sizes of the file around a deletion, and how long commits wait meanwhile; not a test.
dhpmap_program(NAME dhpmap_space_bench SOURCES unit/storage/space_bench.cc LIBS dhpmap_storage dhpmap_test_scenes)
set_target_properties(dhpmap_space_bench PROPERTIES EXCLUDE_FROM_ALL ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)

# Commits and reads of the store on PostgreSQL against SQLite's; not a test.
dhpmap_program(NAME dhpmap_postgres_bench SOURCES unit/storage/blob_reads.cc unit/storage/postgres_bench.cc LIBS dhpmap_storage dhpmap_test_scenes)
set_target_properties(dhpmap_postgres_bench PROPERTIES EXCLUDE_FROM_ALL ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
