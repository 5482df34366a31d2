// SPDX-License-Identifier: BSD-3-Clause
// GCC 12 has no #embed.
  .section .rodata
  .macro embed symbol, file
  .global dhpmap_web_\symbol\()_begin, dhpmap_web_\symbol\()_end
dhpmap_web_\symbol\()_begin:
  .incbin "\file"
dhpmap_web_\symbol\()_end:
  .endm
  embed html, index.html.gz
  embed css, viewer.css.gz
  embed viewer, viewer.js.gz
  embed icon, icon.svg.gz
  .section .note.GNU-stack, "", %progbits
