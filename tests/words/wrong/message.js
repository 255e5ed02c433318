// An oracle in a comment is no sentence for users.
const words = `State ${"of open pairs"}`;
