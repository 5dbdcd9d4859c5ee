// Whose clicks this page sends.

export const ME = "local";
