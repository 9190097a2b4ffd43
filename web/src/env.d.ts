/** The version of this page. */
declare const __VERSION__: string;
/** The WebSocket sub-protocol of the types this page was built from. */
declare const __PROTOCOL__: string;
