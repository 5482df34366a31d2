#!/bin/sh
# ccache.sh CCACHE COMPILER ARGUMENT...: CCACHE of a build with precompiled headers. One that still stands where it is to be made
# anew would be read as one to be used: ccache then looks at it, not at the headers in it, and may return it from its cache.
for argument in "$@"; do
  case $argument in *.gch) rm -f "$argument" ;; esac
done
CCACHE_SLOPPINESS=pch_defines,time_macros exec "$@"
